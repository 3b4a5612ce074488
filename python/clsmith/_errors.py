"""The exception of clsmith."""


class ClsmithError(Exception):
    """Findings that stopped the work: all of them in ``findings``, the first error in the other attributes."""

    def __init__(self, findings):
        self.findings = list(findings)
        errors = [found for found in self.findings if found.severity == "error" and not found.allowed]
        first = (errors or self.findings)[0]
        self.code = first.code
        self.message = first.message
        self.help = first.help
        self.file = first.file
        self.line = first.line
        self.column = first.column
        self.span = first.span
        text = str(first)
        if first.help:
            text += f"\n{first.help}"
        if len(self.findings) > 1:
            text += f"\n({len(self.findings)} findings; see .findings)"
        super().__init__(text)

    def __reduce__(self):
        # Findings are objects of the extension module and are not pickled; another process gets the text.
        return (_Sent, (self.args[0], self.code))


class _Sent(ClsmithError):
    """A `ClsmithError` that came from another process: its text and its code."""

    def __init__(self, text, code):
        Exception.__init__(self, text)
        self.code, self.message, self.findings = code, text, []
        self.help = self.file = self.line = self.column = self.span = None

    def __reduce__(self):
        return (_Sent, (self.args[0], self.code))
