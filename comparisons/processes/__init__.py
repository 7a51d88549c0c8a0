"""Programs of others run in processes of their own, with limits, and end when a run ends."""
