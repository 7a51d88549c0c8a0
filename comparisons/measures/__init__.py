"""Global measures of difference, and the gates of other suites: reported, never the verdict."""
