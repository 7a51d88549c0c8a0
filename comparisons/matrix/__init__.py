"""Scenes × renderers: what is to be run, running it, and the results directory."""
