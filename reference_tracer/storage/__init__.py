"""What is kept from run to run, and how it is told that our code has changed since."""
