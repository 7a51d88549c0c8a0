"""From what a program renders to a grade that can be proved, and the reason for it."""
