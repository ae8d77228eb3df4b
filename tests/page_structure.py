"""The elements of a page, shared by the tests of the report."""

from test_viewer import Structure


class PageStructure(Structure):
    """Elements as the viewer's tests record them, and pictures, which are not closed either."""

    def handle_starttag(self, tag, attributes):
        super().handle_starttag(tag, attributes)
        if tag == "img":
            self.open.pop()
