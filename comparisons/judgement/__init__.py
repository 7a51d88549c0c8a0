"""From what a renderer gave and what it may give to a verdict."""
