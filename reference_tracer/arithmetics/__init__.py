"""The number types that the source runs in, and how kernels are made of it."""
