"""The court: rays whose hit is disputed in public, with the exact truth, put to several programs and forms."""
