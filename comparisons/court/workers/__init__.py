"""Processes that put a court's questions to programs of others, one file a program."""
