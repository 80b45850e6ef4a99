"""An owner who answers the guide without a page."""

from plumb.text.values import MM


class PreparedOwner:
    """Answers each question by a function of its text; `said` holds what was said and asked."""

    unit = MM

    def __init__(self, answer):
        self.said, self._answer = [], answer

    def say(self, text):
        self.said.append(text)

    def _ask(self, question):
        self.said.append(question)
        return self._answer(question)

    def agrees(self, what, act):
        return self._ask(what) == "y"

    def says_yes(self, question):
        return self._ask(question) == "y"

    def choice(self, question, answers):
        letter = self._ask(question)
        assert letter in answers
        return letter

    def number(self, question, low, high, *, usual=None, kind="length"):
        size = float(self._ask(question))
        assert low <= size <= high
        return size
