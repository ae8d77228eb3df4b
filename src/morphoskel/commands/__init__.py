"""The subcommands of ``morphoskel`` that look at results: export, compare and view."""
