"""VTK: what we ask of it, and the process that it runs in."""
