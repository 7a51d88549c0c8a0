"""What drawing with a z-buffer makes of a pixel, in terms of rays."""
