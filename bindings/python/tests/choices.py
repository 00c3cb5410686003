# SPDX-License-Identifier: MIT
"""The options of questions, and the bounds that they leave to each shaft."""

import numpy as np


def rows(lists):
    assert lists.offsets[0] == 0 and lists.offsets[-1] == len(lists.indices)
    return list(lists)


def lists_of_bits(bits):
    return [np.flatnonzero(row) for row in bits]


def same_lists(found, wanted):
    assert [sorted(row) for row in found] == [sorted(row) for row in wanted]


def layers_of(bounds):
    """Layers that leave out some bounds at each choice; bound 0 is in none, bound 1 in the last of 32."""
    layers = 1 << (np.arange(bounds) % 5)
    layers[:2] = 0, 2**31
    return layers


def choices(kept, layers=None):
    """Options, alone and together, and which bounds they leave to each shaft, given bits of what shafts keep."""
    shafts, bounds = kept.shape
    random = np.random.default_rng(6)
    one = kept.sum(0).argmax()
    each = random.integers(0, bounds, (shafts, 2))
    each[:, 0] = kept.argmax(1)
    mask = np.arange(bounds) % 3 == 0
    only = random.permutation(bounds)[: bounds // 2]
    without_each = np.ones_like(kept)
    without_each[np.arange(shafts)[:, None], each] = False
    alone = [
        (dict(exclude=one), np.arange(bounds) != one),
        (dict(exclude=[one, 3, one]), ~np.isin(np.arange(bounds), [one, 3])),
        (dict(exclude_each=each), without_each),
        (dict(exclude_mask=mask), ~mask),
        (dict(only=only), np.isin(np.arange(bounds), only)),
    ]
    if layers is not None:
        masks = random.integers(1, 32, shafts)
        alone.append((dict(layer_mask=0b101 | 1 << 31), (layers & (0b101 | 1 << 31)) != 0))
        alone.append((dict(layer_mask=masks), (layers & masks[:, None]) != 0))
    together, left = {}, np.ones_like(kept)
    for options, some in alone:
        together |= options
    for options, some in alone:
        if all(together[name] is value for name, value in options.items()):
            left &= some
    for options, some in [*alone, (together, left)]:
        some = np.broadcast_to(some, kept.shape)
        assert ((kept & some) != kept).any() and (kept & some).any()
        yield options, some
    yield dict(only=[]), np.zeros_like(kept)


def of_one(options, i):
    """The same options for shaft i alone."""
    options = dict(options)
    if "exclude_each" in options:
        options["exclude"] = np.hstack([options.pop("exclude_each")[i], options.get("exclude", [])]).astype(int)
    if np.ndim(options.get("layer_mask", 0)):
        options["layer_mask"] = options["layer_mask"][i]
    return options


def check_options(holder, shafts, with_layers=True, **test):
    """All questions of all bounds, with every option, against bits that are asked without options."""
    kept, inside = holder.classify(shafts, **test)
    np.testing.assert_array_equal(holder.cull(shafts, **test), kept)
    assert inside.any() and (inside != kept).any() and not (inside & ~kept).any()
    if with_layers:
        holder.set_layers(layers_of(len(holder)))
    for options, left in choices(kept, layers_of(len(holder)) if with_layers else None):
        check(holder, shafts, kept & left, inside & left, options | test)


def check(holder, shafts, kept, inside, options):
    np.testing.assert_array_equal(holder.cull(shafts, **options), kept)
    np.testing.assert_array_equal(holder.classify(shafts, **options), [kept, inside])
    np.testing.assert_array_equal(holder.any(shafts, **options), kept.any(1))
    np.testing.assert_array_equal(holder.count(shafts, **options), kept.sum(1))
    overlapping, contained = (kept & ~inside), inside
    np.testing.assert_array_equal(holder.count_classified(shafts, **options), [overlapping.sum(1), contained.sum(1)])
    lists = rows(holder.list(shafts, **options))
    same_lists(lists, lists_of_bits(kept))
    if "only" in options:
        assert [list(row) for row in lists] == [[i for i in options["only"] if bits[i]] for bits in kept]
    for found, wanted in zip(holder.list_classified(shafts, **options), (overlapping, contained)):
        same_lists(rows(found), lists_of_bits(wanted))
    for limit in (0, 1, 3, 10**9):
        np.testing.assert_array_equal(holder.count(shafts, limit=limit, **options), np.minimum(kept.sum(1), limit))
        for some, every in zip(rows(holder.list(shafts, limit=limit, **options)), lists):
            np.testing.assert_array_equal(some, every[:limit])
    for i in (0, len(shafts) // 2, len(shafts) - 1):
        one, mine = shafts[i], of_one(options, i)
        np.testing.assert_array_equal(holder.cull(one, **mine), kept[i])
        np.testing.assert_array_equal(holder.classify(one, **mine), [kept[i], inside[i]])
        assert holder.any(one, **mine) is bool(kept[i].any())
        assert holder.count(one, **mine) == kept[i].sum()
        assert holder.count(one, limit=2, **mine) == min(kept[i].sum(), 2)
        assert holder.count_classified(one, **mine) == (overlapping[i].sum(), contained[i].sum())
        np.testing.assert_array_equal(holder.list(one, **mine), lists[i])
        np.testing.assert_array_equal(holder.list(one, limit=2, **mine), lists[i][:2])
        for found, wanted in zip(holder.list_classified(one, **mine), (overlapping, contained)):
            np.testing.assert_array_equal(np.sort(found), np.flatnonzero(wanted[i]))
