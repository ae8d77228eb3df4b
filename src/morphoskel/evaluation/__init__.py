"""What a result is worth: distances, averages, and the two protocols under which the paper's numbers can be read."""
