"""One module a category: the names of its parts and the function that builds a random shape of it."""
