"""Seeded families of small scenes at the extremes of geometry and optics; catalogue.py holds the table."""
