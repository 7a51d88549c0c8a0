"""The physics, written once: what is instantiated for each number type, one topic a file."""
