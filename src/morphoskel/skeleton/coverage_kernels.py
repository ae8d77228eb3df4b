"""Compiled loop of the coverage selection."""

import numpy as np

from morphoskel.compiled import kernel


@kernel
def cover(surface, centres, radii, first, width, tolerance, chosen):
    """Choose balls one by one, each for the surface point that is explained worst; see ``coverage.choose_covering``.

    `chosen` receives the indices of the balls in the order in which they are chosen. A surface point that no ball
    left can explain better, or none without loss to the others while its error is within `tolerance`, is given up
    until another ball comes close to it. Once all are given up, the ball farthest from those chosen comes next.
    """
    to_centre = np.full(len(surface), np.inf)
    error = np.full(len(surface), np.inf)
    given_up = np.zeros(len(surface), dtype=np.bool_)
    free = np.full(len(centres), np.inf)  # distance to the nearest chosen centre; -1 once chosen itself
    best = np.empty(width, dtype=np.int64)
    best_error = np.empty(width)
    ball = first
    for place in range(len(chosen)):
        chosen[place] = ball
        _insert(surface, centres, radii, ball, to_centre, error, given_up, free)
        if place + 1 == len(chosen):
            break
        ball = -1
        while ball < 0:
            worst = _worst(error, given_up)
            if worst < 0:
                ball = np.argmax(free)
                break
            found = _nominate(surface[worst], centres, radii, free, to_centre[worst], error[worst], best, best_error)
            if found == 0:
                given_up[worst] = True
            else:
                ball, gain = _most_helpful(surface, centres, radii, best[:found], to_centre, error)
                if gain <= 0.0 and error[worst] <= tolerance:
                    given_up[worst] = True
                    ball = -1


@kernel
def _insert(surface, centres, radii, ball, to_centre, error, given_up, free):
    x, y, z = centres[ball]
    for i in range(len(surface)):
        distance = np.sqrt((surface[i, 0] - x) ** 2 + (surface[i, 1] - y) ** 2 + (surface[i, 2] - z) ** 2)
        if distance < to_centre[i]:
            to_centre[i] = distance
            error[i] = abs(distance - radii[ball])
            given_up[i] = False
    for j in range(len(centres)):
        distance = np.sqrt((centres[j, 0] - x) ** 2 + (centres[j, 1] - y) ** 2 + (centres[j, 2] - z) ** 2)
        if distance < free[j]:
            free[j] = distance
    free[ball] = -1.0


@kernel
def _worst(error, given_up):
    worst = -1
    largest = 0.0
    for i in range(len(error)):
        if error[i] > largest and not given_up[i]:
            largest = error[i]
            worst = i
    return worst


@kernel
def _nominate(point, centres, radii, free, to_centre, error, best, best_error):
    """Fill `best` with the free balls that explain `point` best, and return how many there are."""
    found = 0
    for j in range(len(centres)):
        if free[j] < 0.0:
            continue
        distance = np.sqrt(
            (point[0] - centres[j, 0]) ** 2 + (point[1] - centres[j, 1]) ** 2 + (point[2] - centres[j, 2]) ** 2
        )
        own = abs(distance - radii[j])
        if distance >= to_centre or own >= error or (found == len(best) and own >= best_error[found - 1]):
            continue
        if found < len(best):
            found += 1
        place = found - 1
        while place > 0 and best_error[place - 1] > own:
            best_error[place] = best_error[place - 1]
            best[place] = best[place - 1]
            place -= 1
        best_error[place] = own
        best[place] = j
    return found


@kernel
def _most_helpful(surface, centres, radii, balls, to_centre, error):
    """Return the ball that lowers the sum of squared errors most."""
    winner = balls[0]
    most = -np.inf
    for j in balls:
        gain = 0.0
        for i in range(len(surface)):
            squared = (
                (surface[i, 0] - centres[j, 0]) ** 2
                + (surface[i, 1] - centres[j, 1]) ** 2
                + (surface[i, 2] - centres[j, 2]) ** 2
            )
            if squared < to_centre[i] * to_centre[i]:
                distance = np.sqrt(squared)
                if distance < to_centre[i]:  # the square of a rounded root may exceed what the root was taken of
                    gain += error[i] ** 2 - (distance - radii[j]) ** 2
        if gain > most:
            most = gain
            winner = j
    return winner, most
