"""Submissions of a whole class: found, unpacked, built, graded side by side, and compared with one another."""
