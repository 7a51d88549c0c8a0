"""What renderers declare of their arithmetic and shortcuts, and what that makes of the tracer."""
