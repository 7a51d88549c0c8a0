"""Mitsuba 3: what we ask of it, and the process that it runs in."""
