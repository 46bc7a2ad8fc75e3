"""Chemical reactions as Markov chains: networks, and how to simulate them approximately, exactly, and both together."""
