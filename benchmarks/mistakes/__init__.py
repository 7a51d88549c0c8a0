"""Mistakes switched on in the example tracers, and how well `raytruth grade` tells them: docs/diagnosis.md."""
