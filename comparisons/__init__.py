"""Who the tracer is held against, and the verdict."""
