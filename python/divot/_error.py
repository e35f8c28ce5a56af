"""What divot raises."""


class Error(ValueError):
    """Everything that is wrong with an input, in the words of the command line; `problems` has each by itself."""

    def __init__(self, problems):
        super().__init__("\n".join(str(problem) for problem in problems))
        self.problems = list(problems)
