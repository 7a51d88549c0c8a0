"""Ray trees that a program prints, held against the tracer's own, ray by ray."""
