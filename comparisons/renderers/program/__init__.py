"""Any program as a renderer: what its user declares of it, and how it is run."""
