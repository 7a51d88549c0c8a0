"""The front door: command line. It wires, it decides nothing."""
