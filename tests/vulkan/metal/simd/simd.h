// The test needs nothing of it.
