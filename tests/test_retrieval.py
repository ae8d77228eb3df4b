import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from morphoskel.evaluation.retrieval import average_precisions


def naive_average_precision(query, descriptors, labels, include_query):
    """Follow the definition, one rank after the other."""
    others = [index for index in range(len(labels)) if index != query]
    others.sort(key=lambda index: (((descriptors[index] - descriptors[query]) ** 2).sum(), index))
    ranking = [query, *others] if include_query else others
    precisions, found = [], 0
    for rank, index in enumerate(ranking, 1):
        if labels[index] == labels[query]:
            found += 1
            precisions.append(found / rank)
    return np.mean(precisions) if precisions else np.nan


@pytest.mark.parametrize("include_query", [True, False])
@settings(max_examples=60, deadline=None)
@given(data=st.data())
def test_it_agrees_with_the_definition(include_query, data):
    """Descriptors on a small grid have many ties, all of them exact."""
    shapes = data.draw(st.integers(1, 12))
    descriptors = np.array(data.draw(st.lists(st.tuples(*[st.integers(-2, 2)] * 2), min_size=shapes, max_size=shapes)))
    labels = np.array(data.draw(st.lists(st.integers(0, 3), min_size=shapes, max_size=shapes)))
    expected = [naive_average_precision(query, descriptors, labels, include_query) for query in range(shapes)]
    np.testing.assert_allclose(average_precisions(descriptors, labels, include_query), expected)


def test_it_agrees_with_the_definition_over_several_blocks():
    generator = np.random.default_rng(0)
    descriptors = generator.normal(size=(600, 8)).astype(np.float32)
    labels = generator.integers(0, 20, 600)
    for include_query in (True, False):
        result = average_precisions(descriptors, labels, include_query)
        for query in (0, 255, 256, 511, 599):
            exact = naive_average_precision(query, descriptors.astype(float), labels, include_query)
            assert result[query] == pytest.approx(exact)


def test_a_case_by_hand():
    """Query 0 ranks 0, 1, 2, 3; relevant are 0 and 2: (1 + 2/3) / 2 with itself, 1/2 without."""
    descriptors, labels = np.array([[0.0], [1], [2.5], [4.5]]), np.array([0, 1, 0, 1])
    assert average_precisions(descriptors, labels, include_query=True)[0] == pytest.approx(5 / 6)
    assert average_precisions(descriptors, labels, include_query=False)[0] == pytest.approx(1 / 2)


def test_perfect_descriptors_give_one():
    labels = np.repeat(np.arange(5), 7)
    for include_query in (True, False):
        assert average_precisions(np.eye(5)[labels], labels, include_query) == pytest.approx(1)


def test_random_descriptors_gain_from_finding_themselves():
    """The gain of a class of R shapes is about the first relevant item, 1 / R, and a little more."""
    generator = np.random.default_rng(0)
    labels = np.repeat(np.arange(10), 62)
    descriptors = generator.normal(size=(620, 16))
    included, excluded = (average_precisions(descriptors, labels, include).mean() for include in (True, False))
    assert excluded == pytest.approx(0.1, abs=0.02)
    assert 1 / 62 < included - excluded < 3 / 62


def test_the_query_comes_first_even_among_equals():
    descriptors, labels = np.zeros((4, 3)), np.array([0, 1, 1, 0])
    with_query = average_precisions(descriptors, labels, include_query=True)
    assert with_query[3] == pytest.approx((1 + 2 / 2) / 2)  # ranks 3, 0, 1, 2
    assert with_query[2] == pytest.approx((1 + 2 / 3) / 2)  # ranks 2, 0, 1, 3
    assert average_precisions(descriptors, labels, include_query=False)[2] == pytest.approx(1 / 2)


def test_the_only_one_of_its_class_has_no_precision_without_itself():
    descriptors, labels = np.arange(3.0)[:, None], np.array([0, 0, 1])
    assert np.isnan(average_precisions(descriptors, labels, include_query=False)).tolist() == [False, False, True]
    assert average_precisions(descriptors, labels, include_query=True)[2] == 1


def test_bad_input_is_refused():
    with pytest.raises(ValueError, match="descriptors and"):
        average_precisions(np.zeros((3, 2)), np.zeros(2, dtype=int), include_query=True)
    with pytest.raises(ValueError, match="finite"):
        average_precisions(np.full((2, 2), np.nan), np.zeros(2, dtype=int), include_query=True)
