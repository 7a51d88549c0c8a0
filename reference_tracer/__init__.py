"""How a scene is rendered from scratch, and what the truth is."""
