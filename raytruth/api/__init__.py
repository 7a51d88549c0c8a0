"""What `import raytruth` offers that is not defined elsewhere, and what the command line calls."""
