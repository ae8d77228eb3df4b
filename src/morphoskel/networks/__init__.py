"""Neural networks: layers and architectures, without their training."""
