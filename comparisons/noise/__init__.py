"""Tests of renderers that draw random numbers."""
