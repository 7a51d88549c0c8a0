"""Which clauses there are, and which tests, scenes and faults hold each. It compares nothing."""
