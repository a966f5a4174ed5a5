"""The error of the package."""


class Error(Exception):
    """Something that the caller can act on: it says where, what was found and what was expected.

    Attributes:
        message: value with its unit, limit, and what to do; it names no file and no line
        file: file that is wrong, or "" if the error is about no file
        line: line in this file, counted from 1; 0 if not known
        column: column in this line, counted from 1; 0 if not known
        code: "usage", "program", "file", "model", "machine" or "interrupted"
    """

    def __init__(self, message, file="", line=0, column=0, code="usage"):
        place = ":".join([file] + [str(n) for n in (line, column) if n]) if file else ""
        super().__init__(f"{place}: {message}" if place else message)
        self.message = message
        self.file = file
        self.line = line
        self.column = column
        self.code = code

    def __reduce__(self):
        return (Error, (self.message, self.file, self.line, self.column, self.code))
