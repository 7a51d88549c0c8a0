"""What holds a program of others back: a ladder of sandboxes, of which each machine has some rungs."""
