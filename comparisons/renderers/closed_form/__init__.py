"""Closed forms for scenes of one primitive, written without a look at the tracer."""
