from morphoskel.learning.plain_values import as_tuples


def test_lists_of_lists_become_tuples():
    assert as_tuples([[1, 2], [3.5]]) == ((1, 2), (3.5,))
