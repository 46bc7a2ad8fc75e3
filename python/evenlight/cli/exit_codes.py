"""What the program returns to the shell when it did not do all that it was asked."""

EXIT_ERROR = 2
EXIT_INTERRUPTED = 130  # 128 + SIGINT, as shells have it
