"""What is written down and read again: results, images, evidence. All that a report may know of the judgement."""
