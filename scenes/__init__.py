"""What is rendered: the scene model, what a scene requires, the library, and exporters."""
