"""Feed damaged files to every reader of the project: `make fuzz`, see docs/fuzzing.md."""
