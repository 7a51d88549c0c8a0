"""How results are shown: pure readers of a results directory."""
