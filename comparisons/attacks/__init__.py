"""Attacks on the sandboxes, tried on this machine, and the sandbox that is chosen by what held."""
