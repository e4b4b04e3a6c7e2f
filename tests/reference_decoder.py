#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Reference decoder of .wmc mesh files, version 0.5.

Written from docs/wmc_format.md alone, without a look at any other implementation. It follows that document's
sections and names: whoever reads one should find his way in the other. It is meant to be read and to be compared
with, not to be fast.

    reference_decoder.py FILE.wmc [--level N] [--output MESH.obj] [--digest]

As a module: Decoder(data).decode(level), then result(): vertices, faces; and, if the file has attributes,
attributes.values(): pairs of an Attribute (of, kind, name, ...) and what its rows stand for, in the order of the
vertices, faces or corners of result().

Exit code 0: fine. 1: the file is damaged or cut (the outcome of section 11.1 is on stderr; a cut file still gives
the mesh that section 11.2 says). 2: wrong use.
"""

import argparse
import struct
import sys
from bisect import bisect_left, insort
from collections import deque
from math import floor, isfinite, isqrt, sqrt

NONE = -1                                   # no vertex, no corner

MAX_COUNT = 715827882                       # vertices, faces of a level (4.3)
OWN_LIMIT = 50000000                        # this decoder's own limit of vertices, faces (LimitExceeded)


# ----------------------------------------------------------------------------------------------------------------
# 11.1 Outcomes
# ----------------------------------------------------------------------------------------------------------------

OUTCOMES = {"NotWmc": 10, "VersionTooNew": 11, "VersionTooOld": 12, "Truncated": 20, "Corrupt": 21, "ChecksumMismatch": 22,
            "LimitExceeded": 30}


class Outcome(Exception):
    def __init__(self, name, why):
        super().__init__(name, why)
        self.name = name
        self.why = why


class Exhausted(Exception):
    """The range decoder is exhausted (5.1). The document lets it return zeros from then on; nothing read after it
    means anything, so here it is raised at once."""


def corrupt(why):
    return Outcome("Corrupt", why)


# ----------------------------------------------------------------------------------------------------------------
# 2. Notation
# ----------------------------------------------------------------------------------------------------------------

def trunc_div(a, b):
    """trunc(a / b)"""
    return a // b if (a >= 0) == (b > 0) else -(-a // b)


def ceil_div(a, b):
    return -(-a // b)


def bitlen(x):
    return x.bit_length()


def clamp(x, lo, hi):
    return lo if x < lo else hi if x > hi else x


def class_(x, lo, hi):
    return clamp(x, lo, hi) - lo


def wrap32(x):
    return ((x + 0x80000000) & 0xFFFFFFFF) - 0x80000000


def wrap64(x):
    return ((x + (1 << 63)) & ((1 << 64) - 1)) - (1 << 63)


def read_varint(data, offset):
    """LEB128. The value and the offset behind it; None if the data end in it."""
    value = 0
    for i in range(10):
        if offset + i >= len(data):
            return None
        if i == 9:
            break
        byte = data[offset + i]
        value |= (byte & 127) << (7 * i)
        if byte < 128:
            return value, offset + i + 1
    raise corrupt("a varint of more than 9 bytes")


def varint_size(n):
    return max(1, (bitlen(n) + 6) // 7)


# ----------------------------------------------------------------------------------------------------------------
# Appendix A: XXH32
# ----------------------------------------------------------------------------------------------------------------

def xxh32(data):
    P1, P2, P3, P4, P5 = 2654435761, 2246822519, 3266489917, 668265263, 374761393
    M = 0xFFFFFFFF

    def rotl(x, r):
        return ((x << r) | (x >> (32 - r))) & M

    n = len(data)
    whole = n - n % 16
    if n >= 16:
        v = [(P1 + P2) & M, P2, 0, -P1 & M]
        for words in struct.iter_unpack("<4I", memoryview(data)[:whole]):
            for i in range(4):
                x = (v[i] + words[i] * P2) & M
                v[i] = (((x << 13) | (x >> 19)) * P1) & M
        h = (rotl(v[0], 1) + rotl(v[1], 7) + rotl(v[2], 12) + rotl(v[3], 18)) & M
    else:
        h = P5
    h = (h + n) & M
    offset = whole
    while offset + 4 <= n:
        w = int.from_bytes(data[offset:offset + 4], "little")
        h = (rotl((h + w * P3) & M, 17) * P4) & M
        offset += 4
    for b in data[offset:]:
        h = (rotl((h + b * P5) & M, 11) * P1) & M
    h = ((h ^ (h >> 15)) * P2) & M
    h = ((h ^ (h >> 13)) * P3) & M
    return h ^ (h >> 16)


# ----------------------------------------------------------------------------------------------------------------
# 3. Container
# ----------------------------------------------------------------------------------------------------------------

MAGIC = bytes([0x8B, 0x57, 0x4D, 0x43, 0x0D, 0x0A, 0x1A, 0x0A])


class Chunk:
    """type, length (n), payload (what there is of it), whole, and end: where the next chunk begins."""


def read_chunk(data, begin):
    """The chunk at an offset; None if the data end before the payload begins. Checks the checksum of a whole one."""
    if begin >= len(data):
        return None
    length = read_varint(data, begin + 1)
    if length is None:
        return None
    chunk = Chunk()
    chunk.type = chr(data[begin])
    chunk.length, first = length
    rest = len(data) - first
    chunk.whole = rest >= chunk.length + 4
    chunk.payload = data[first:first + min(chunk.length, rest)]
    chunk.end = first + chunk.length + 4
    if chunk.whole:
        stored = int.from_bytes(data[chunk.end - 4:chunk.end], "little")
        if stored != xxh32(data[begin:chunk.end - 4]):
            raise Outcome("ChecksumMismatch", "chunk %s" % chunk.type)
    return chunk


def check_magic(data):
    start = data[:8]
    if start == MAGIC:
        return
    if len(start) > 0 and start == MAGIC[:len(start)]:
        raise Outcome("Truncated", "in the magic")
    if start[1:4] == b"WMC":
        raise corrupt("the magic is damaged, as by a transfer in text mode")
    raise Outcome("NotWmc", "no magic")


# ----------------------------------------------------------------------------------------------------------------
# 4. The head
# ----------------------------------------------------------------------------------------------------------------

BASE, SPLIT, PRECISE = "base", "split", "precise"
FEATURE_CHUNKS = "ROXA"


class Head:
    pass


def read_head(data):
    """The head, and the offset behind its chunk. In the order of 11.3."""
    check_magic(data)
    chunk = read_chunk(data, 8)
    if chunk is None:
        raise Outcome("Truncated", "in the head")
    if chunk.type != "H":
        raise corrupt("the first chunk is not the head")
    payload = chunk.payload
    if len(payload) >= 2 and payload[:2] != b"\x00\x05":
        newer = payload[:2] > b"\x00\x05"
        raise Outcome("VersionTooNew" if newer else "VersionTooOld", "version %d.%d" % (payload[0], payload[1]))
    if not chunk.whole:
        raise Outcome("Truncated", "in the head")
    head = read_fixed_fields(payload)
    read_level_table(head, payload[head.table:])
    check_level_table(head)
    if max(head.vertices[head.J], head.faces[head.J], head.original_vertices, head.original_faces) > OWN_LIMIT:
        raise Outcome("LimitExceeded", "more vertices or faces than this decoder takes")
    return head, chunk.end


def read_fixed_fields(payload):
    """4.1, and what 12.1 adds"""
    if len(payload) < 5:
        raise corrupt("the head's fixed fields are not all there")
    head = Head()
    flags, head.features, head.bits = payload[2:5]
    head.mode = flags & 7
    head.wgc = flags >> 3 & 1
    head.wide = flags >> 4 & 1
    head.lifting = (flags >> 5 & 3) - 1                     # classic: -1: off, else k of the k-disc
    head.predictors = flags >> 5 & 3                        # compact: few, all, all and repeats
    head.rich = flags >> 7
    head.compact = head.mode == 1
    if head.mode > 1 or head.features > 15 or not 1 <= head.bits <= 24 or (head.compact and head.predictors > 2):
        raise corrupt("a field of the head is out of range")
    layout = "<4dI" if head.wide else "<4fI"
    if len(payload) < 5 + struct.calcsize(layout):
        raise corrupt("the head's fixed fields are not all there")
    *origin, scale, head.digest = struct.unpack_from(layout, payload, 5)
    offset = 5 + struct.calcsize(layout)
    head.origin = tuple(origin)

    def varint():
        nonlocal offset
        got = read_varint(payload, offset)
        if got is None:
            raise corrupt("the head's fields are not all there")
        offset = got[1]
        return got[0]

    head.original_vertices = head.original_faces = 0
    if head.features & 1:
        head.original_vertices = varint()
        head.original_faces = varint()
        if max(head.original_vertices, head.original_faces) > MAX_COUNT:
            raise corrupt("counts of the original are out of range")
    head.attributes, head.textures = [], []
    if head.features & 8:
        head.attributes, head.textures, offset = read_attributes(payload, offset)
    head.feature_length = {}
    for i in range(4):
        if head.features >> i & 1:
            head.feature_length[FEATURE_CHUNKS[i]] = varint()
            if head.feature_length[FEATURE_CHUNKS[i]] > 1 << 48:
                raise corrupt("length of a feature's chunk is out of range")
    levels = varint()
    if not all(isfinite(x) for x in origin):
        raise corrupt("origin is not finite")
    head.step = scale if head.wide else scale / ((1 << head.bits) - 1)
    if not isfinite(head.step) or not head.step > 0:
        raise corrupt("step is not finite and positive")
    if not 1 <= levels <= 4096:
        raise corrupt("number of levels is out of range")
    head.J = levels - 1
    head.table = offset
    return head


def read_level_table(head, data):
    """4.2"""
    V, F, B, C, T = (AdaptiveUnsigned(32) for _ in range(5))
    R, E, S = AdaptiveSigned(32), AdaptiveSigned(9), AdaptiveUnsigned(5)
    ends, more = AdaptiveBit(), AdaptiveBit()
    J = head.J
    head.vertices, head.faces, head.error, head.shift, head.bytes, head.connectivity, head.ends, head.kind = (
        [None] * (J + 1) for _ in range(8))
    try:
        decoder = RangeDecoder(data)
        for i in range(J, -1, -1):
            if i == J:
                head.vertices[J] = V.read(decoder)
                head.faces[J] = F.read(decoder)
                head.error[J] = 0
                head.shift[J] = 0
            elif head.kind[i + 1] == PRECISE:
                head.vertices[i] = head.vertices[i + 1]
                head.faces[i] = head.faces[i + 1]
                head.shift[i] = head.shift[i + 1] + 1 + S.read(decoder)
                head.error[i] = (head.error[i + 1] + E.read(decoder)) % 256
            else:
                d = V.read(decoder)
                head.vertices[i] = (head.vertices[i + 1] - d) % (1 << 32)
                head.faces[i] = (head.faces[i + 1] - 2 * d + R.read(decoder)) % (1 << 32)
                head.shift[i] = head.shift[i + 1]
                head.error[i] = (head.error[i + 1] + E.read(decoder)) % 256
            head.bytes[i] = B.read(decoder)
            head.connectivity[i] = C.read(decoder)
            if head.features & 8:
                head.connectivity[i] += T.read(decoder)         # together at most `bytes`
            head.ends[i] = bit(decoder, ends, 60)
            head.kind[i] = BASE if i == 0 else SPLIT
            if head.compact and i > 0 and bit(decoder, more, 60) == 1:
                head.kind[i] = PRECISE
    except Exhausted:
        raise corrupt("the level table is cut")


def check_level_table(head):
    """4.3"""
    vertices, faces = head.vertices, head.faces
    good = head.ends[head.J] == 1 and head.shift[0] < head.bits and vertices[0] <= 3 * faces[0]
    for i in range(head.J + 1):
        good = good and vertices[i] <= MAX_COUNT and faces[i] <= MAX_COUNT
        good = good and head.connectivity[i] <= head.bytes[i]
        if i > 0:
            good = good and vertices[i - 1] <= vertices[i] <= vertices[i - 1] + 4 * faces[i - 1]
            good = good and 0 < faces[i - 1] <= faces[i] <= 4 * faces[i - 1]
    if head.features & 1:
        good = good and head.original_faces >= faces[head.J]
    if not good:
        raise corrupt("the level table contradicts itself")


def level_prefixes(head, offset):
    """4.4, from the offset behind the head's chunk. For information; the decoder does without."""
    prefix = []
    a = 0
    while a <= head.J:
        b = a
        while not head.ends[b]:
            b += 1
        n = sum(head.bytes[a:b + 1])
        at = offset + 1 + varint_size(n)
        for i in range(a, b + 1):
            at += head.bytes[i]
            prefix.append(at)
        prefix[b] = offset = at + 4
        a = b + 1
    return prefix


# ----------------------------------------------------------------------------------------------------------------
# 5. Entropy coding
# ----------------------------------------------------------------------------------------------------------------

class RangeDecoder:
    """5.1"""

    def __init__(self, data):
        self.data = data
        self.next = 0
        self.low = 0
        self.high = 0xFFFFFFFF
        self.code = 0
        self.missing = 0
        for _ in range(4):
            self.shift()

    def shift(self):
        have = self.next < len(self.data)
        self.code = (self.code << 8 | (self.data[self.next] if have else 0)) & 0xFFFFFFFF
        self.missing = (self.missing << 8 | (0 if have else 255)) & 0xFFFFFFFF
        if have:
            self.next += 1

    def decode(self, p):
        middle = self.low + (((self.high - self.low) * p) >> 16)
        value = 1 if self.code <= middle else 0
        if self.missing != 0 and value != (1 if (self.code | self.missing) <= middle else 0):
            raise Exhausted()
        if value:
            self.high = middle
        else:
            self.low = middle + 1
        while self.low >> 24 == self.high >> 24:
            self.low = (self.low << 8) & 0xFFFFFFFF
            self.high = (self.high << 8 | 255) & 0xFFFFFFFF
            self.shift()
        return value

    def raw(self, k):
        x = 0
        for _ in range(k):
            x = 2 * x + self.decode(32768)
        return x


# 5.2 Logistic tables

KNOTS = (22, 36, 60, 98, 162, 267, 439, 720, 1179, 1921, 3108,
         4971, 7812, 11955, 17625, 24743, 32768, 40793, 47911, 53581, 57724, 60565,
         62428, 63615, 64357, 64816, 65097, 65269, 65374, 65438, 65476, 65500, 65514)


def make_squash():
    table = []
    for x in range(-2048, 2048):
        x = clamp(x, -2047, 2047)
        k = (x + 2048) >> 7
        r = (x + 2048) & 127
        table.append((KNOTS[k] * (128 - r) + KNOTS[k + 1] * r + 64) >> 7)
    return table


def make_stretch():
    table = []
    x = -2047
    for i in range(4096):
        while x < 2047 and SQUASH[x + 2048] < 16 * i + 8:
            x += 1
        table.append(x)
    return table


SQUASH = make_squash()                      # of x + 2048
STRETCH = make_stretch()                    # of p >> 4


def squash(x):
    return SQUASH[clamp(x, -2047, 2047) + 2048]


def stretch(p):
    return STRETCH[p >> 4]


# 5.3 AdaptiveBit

STEPS = [131072 // (2 * n + 3) for n in range(256)]         # S[n]


class AdaptiveBit:
    __slots__ = ("P", "age")

    def __init__(self):
        self.P = 1 << 21
        self.age = 0

    def p(self):
        return clamp(self.P >> 6, 1, 65535)

    def learn(self, value, limit):
        target = 4194303 if value else 0
        self.P += ((target - self.P) * STEPS[self.age]) >> 16
        if self.age < limit:
            self.age += 1


def bits_of(count):
    return [AdaptiveBit() for _ in range(count)]


def bit(decoder, model, limit):
    value = decoder.decode(model.p())
    model.learn(value, limit)
    return value


# 5.4 AdaptiveUnsigned, AdaptiveSigned

class AdaptiveUnsigned:
    def __init__(self, M):
        self.M = M
        self.length = bits_of(M)
        self.top = bits_of(M + 1)           # [2..M]

    def read(self, decoder):
        n = 0
        while n < self.M and bit(decoder, self.length[n], 60) == 1:
            n += 1
        if n <= 1:
            return n
        x = 2 + bit(decoder, self.top[n], 60)
        for _ in range(n - 2):
            x = 2 * x + decoder.decode(32768)
        return x


class AdaptiveSigned:
    def __init__(self, M):
        self.magnitude = AdaptiveUnsigned(M)

    def read(self, decoder):
        m = self.magnitude.read(decoder)
        if m == 0:
            return 0
        return -m if decoder.decode(32768) == 1 else m


# 5.5 Mixer

class Weights:
    """One set of weights of a mixer."""
    __slots__ = ("w", "seen")

    def __init__(self, N):
        self.w = [49152 // (2 * N)] * N
        self.seen = 0

    def sum(self, s):
        return sum(x * y for x, y in zip(s, self.w)) >> 14

    def adjust(self, s, p, value, slow):
        if self.seen < 512:
            self.seen += 1
        rate = slow + 768 // (self.seen + 48)
        e = (((65535 if value else 0) - p) * rate) >> 4
        self.w = [clamp(w + ((x * e + 131072) >> 18), -131071, 131071) for w, x in zip(self.w, s)]


class Mixer:
    def __init__(self, N, sets, slow=3):
        self.sets = [Weights(N) for _ in range(sets)]
        self.slow = slow

    def mix(self, decoder, models, which, limit=255):
        s = [stretch(m.p()) for m in models]
        weights = self.sets[which]
        p = squash(weights.sum(s))
        value = decoder.decode(p)
        weights.adjust(s, p, value, self.slow)
        for m in models:
            m.learn(value, limit)
        return value


# 5.6 PairMixer

class PairMixer:
    def __init__(self, N, sets):
        self.sets = [Weights(N) for _ in range(sets)]
        self.general = Weights(N)
        self.correction = bits_of(32)

    def mix(self, decoder, models, which, limit):
        s = [stretch(m.p()) for m in models]
        weights = self.sets[which]
        a = weights.sum(s)
        b = self.general.sum(s)
        both = clamp((a + b) >> 1, -2047, 2047)
        t = self.correction[(both + 2048) >> 7]
        value = decoder.decode(clamp((3 * squash(both) + t.p()) // 4, 32, 65503))
        weights.adjust(s, squash(a), value, 24)
        self.general.adjust(s, squash(b), value, 24)
        t.learn(value, 255)
        for m in models:
            m.learn(value, limit)
        return value


# ----------------------------------------------------------------------------------------------------------------
# 6. Meshes: words and measures
# ----------------------------------------------------------------------------------------------------------------

class Mesh:
    """The triangles of a level: V[c], opp[c], next[c], prev[c] of corners, and, of vertices, corners[v] (those at v,
    from its first corner (9.1) on, counter-clockwise), boundary[v] and valence[v]."""

    def __init__(self, vertices, triangles):
        self.vertices = vertices
        self.faces = len(triangles)
        self.V = [v for t in triangles for v in t]
        self.next = [c - 2 if c % 3 == 2 else c + 1 for c in range(3 * self.faces)]
        self.prev = [c + 2 if c % 3 == 0 else c - 1 for c in range(3 * self.faces)]
        self.find_opposites()
        self.find_fans()

    def find_opposites(self):
        V = self.V
        at = {}                                             # directed edge -> the corner that faces it
        for c in range(len(V)):
            edge = (V[self.next[c]], V[self.prev[c]])
            if edge in at or edge[0] == edge[1]:
                raise corrupt("two faces have the same edge in the same direction")
            at[edge] = c
        self.opp = [at.get((V[self.prev[c]], V[self.next[c]]), NONE) for c in range(len(V))]

    def find_fans(self):
        V, opp = self.V, self.opp
        first = [NONE] * self.vertices
        number = [0] * self.vertices                        # of faces at the vertex
        for c in range(len(V) - 1, -1, -1):                 # the lowest corner remains
            first[V[c]] = c
            number[V[c]] += 1
        self.boundary = [False] * self.vertices
        for c in range(len(V)):
            if opp[self.prev[c]] == NONE:
                first[V[c]] = c
                self.boundary[V[c]] = True
        self.corners = [[] for _ in range(self.vertices)]
        self.one_fan = True
        for v in range(self.vertices):
            c = first[v]
            fan = self.corners[v]
            while c != NONE:
                fan.append(c)
                d = opp[self.next[c]]
                c = self.next[d] if d != NONE else NONE
                if c == first[v]:
                    break
            if len(fan) != number[v]:
                self.one_fan = False
        self.valence = [number[v] + (1 if self.boundary[v] else 0) for v in range(self.vertices)]

    def ring(self, v):
        """9.1: the neighbours, counter-clockwise"""
        ring = [self.V[self.next[c]] for c in self.corners[v]]
        if self.boundary[v]:
            ring.append(self.V[self.prev[self.corners[v][-1]]])
        return ring

    def vclass(self, v):
        return class_(self.valence[v], 3, 8)


def dist2(a, b):
    return sum(min(abs(x - y), 0x7FFFFFFF) ** 2 for x, y in zip(a, b))


def quarters(x):
    if x == 0:
        return 0
    L = bitlen(x)
    t = x >> (L - 3) if L >= 3 else x << (3 - L)
    return 4 * (L - 1) + (t & 3)


def ratio(q):
    return class_(q >> 1, -5, 6)


def middle_distance(v, a, b):
    """mid(v; a, b), of positions"""
    return quarters(dist2([wrap32(2 * x) for x in v], [wrap32(x + y) for x, y in zip(a, b)]))


# ----------------------------------------------------------------------------------------------------------------
# 7. Level 0: the base mesh, with 12.2 Glued vertices
# ----------------------------------------------------------------------------------------------------------------

class Glue:
    """12.2: which vertices of the base mesh stand for the same vertex of the original."""

    def __init__(self):
        self.first = []                     # first[v], of vertices of the base mesh
        self.copies = []                    # copies[v], where v is its own first: all of them, ascending
        self.copy = bits_of(4)
        self.this = bits_of(32)

    def add(self, first):
        v = len(self.first)
        self.first.append(first)
        self.copies.append([])
        self.copies[first].append(v)

    def first_of(self, v):
        return self.first[v] if v < len(self.first) else v

    def shared(self, v):
        return v != NONE and v < len(self.first) and len(self.copies[self.first[v]]) > 1

    def same(self, v):
        """all that stand for the same original, v among them"""
        return self.copies[self.first[v]] if v < len(self.first) else [v]

    def read(self, decoder, p, q, triangles):
        """first(v) of the new vertex v"""
        v = len(self.first)
        if bit(decoder, self.copy[self.shared(p) + 2 * self.shared(q)], 60) == 0:
            return v
        C = self.candidates(p, q, triangles)
        for i in range(len(C)):
            if bit(decoder, self.this[i], 60) == 1:
                return C[i]
        first = decoder.raw(bitlen(v))
        if first >= v or self.first[first] != first:
            raise corrupt("a copy of no vertex")
        return first

    def candidates(self, p, q, triangles):
        C = []
        for s in p, q:
            if not self.shared(s):
                continue
            for w in self.same(s):
                if w == s:
                    continue
                for u in neighbours(w, triangles):
                    if self.first[u] not in C and len(C) < 32:
                        C.append(self.first[u])
        return C


def neighbours(w, triangles):
    """of a vertex in the base mesh so far (12.2)"""
    found = []
    for t in triangles:
        if w in t:
            i = t.index(w)
            found += [t[(i + 1) % 3], t[(i + 2) % 3]]
            if len(found) >= 24:
                break
    return found[:24]


class BaseMesh:
    def __init__(self, decoder, head, glue):
        self.decoder = decoder
        self.glue = glue                    # None if the file has no restoration
        self.max_vertices = head.vertices[0]
        self.max_faces = head.faces[0]
        bits = head.bits - head.shift[0]
        self.boundary, self.new, self.left, self.right = bits_of(4)
        self.start = [AdaptiveSigned(31) for _ in range(3)]
        self.tip = [AdaptiveSigned(31) for _ in range(3)]
        self.last = (1 << bits >> 1,) * 3
        self.triangles = []
        self.positions = []
        self.edges = set()
        self.from_of = {}
        self.to_of = {}
        self.gates = []

    def read(self):
        """The mesh of level 0 and its positions."""
        while len(self.triangles) < self.max_faces:
            v0 = self.vertex(self.last, self.start, NONE, NONE)
            v1 = self.vertex(self.last, self.start, v0, NONE)
            v2 = self.vertex(self.last, self.start, v0, v1)
            self.triangle(v0, v1, v2)
            while self.gates:
                self.cross(*self.gates.pop())
        if len(self.positions) != self.max_vertices:
            raise corrupt("number of vertices of the base mesh")
        mesh = Mesh(len(self.positions), self.triangles)
        if not mesh.one_fan:
            raise corrupt("a vertex of the base mesh has more than one fan")
        return mesh, self.positions

    def vertex(self, predicted, models, p, q):
        v = len(self.positions)
        if v >= self.max_vertices:
            raise corrupt("too many vertices in the base mesh")
        first = v
        if self.glue:
            first = self.glue.read(self.decoder, p, q, self.triangles)
            self.glue.add(first)
        if first != v:
            position = self.positions[first]
        else:
            position = tuple(wrap32(predicted[k] + models[k].read(self.decoder)) for k in range(3))
        self.positions.append(position)
        self.last = position
        return v

    def triangle(self, a, b, c):
        if a == b or b == c or c == a:
            raise corrupt("a face has a vertex twice")
        self.triangles.append((a, b, c))
        for start, to, behind in (a, b, c), (b, c, a), (c, a, b):
            if (start, to) in self.edges:
                raise corrupt("two faces have the same edge in the same direction")
            self.edges.add((start, to))
            self.to_of[start] = to
            self.from_of[to] = start
            self.gates.append((start, to, behind))

    def cross(self, start, to, behind):
        """pass(from, to, behind)"""
        decoder, P = self.decoder, self.positions
        if (to, start) in self.edges:
            return
        if bit(decoder, self.boundary, 60) == 1:
            return
        if len(self.triangles) >= self.max_faces:
            raise corrupt("too many faces in the base mesh")
        if bit(decoder, self.new, 60) == 1:
            predicted = [wrap32(x + y - z) for x, y, z in zip(P[start], P[to], P[behind])]
            v = self.vertex(predicted, self.tip, start, to)
        elif bit(decoder, self.left, 60) == 1:
            v = self.from_of[start]
        elif bit(decoder, self.right, 60) == 1:
            v = self.to_of[to]
        else:
            v = decoder.raw(bitlen(len(P) - 1))
            if v >= len(P):
                raise corrupt("a face has a vertex that does not exist")
        self.triangle(to, start, v)


# ----------------------------------------------------------------------------------------------------------------
# 8. A split
# ----------------------------------------------------------------------------------------------------------------

class Split:
    """The connectivity of a split as read: child[c] by corner of the parent level, splits[f], special[f],
    diagonal[f] (0, 1, 2), flips (corners e), has_centre: centre[f] or NONE; and, in the order of their numbers, the
    new vertices: origin[i] = (corner c, NONE) or (NONE, face f). parents[i] as in 13.11."""


STATE = {(0, 0): 0, (0, 1): 1, (0, 2): 2, (1, 0): 3, (1, 1): 4, (2, 0): 5}
STATE_NO_FACE = 6


class Connectivity:
    """8.1: what is learned from level to level, and the reading of one level's connectivity."""

    def __init__(self, rich):
        self.rich = rich
        self.A1, self.A3, self.A4 = bits_of(1225), bits_of(1296), bits_of(768)
        if rich:
            self.A6, self.A7, self.A8 = bits_of(784), bits_of(980), bits_of(320)
            self.A9, self.A10 = bits_of(252), bits_of(10164)
            self.split_mixer = PairMixer(8, 49)
            self.C3, self.C4 = bits_of(104), bits_of(156)
            self.flip_mixer = Mixer(4, 1, slow=24)
        else:
            self.A2, self.A5 = bits_of(588), bits_of(1296)
            self.split_mixer = Mixer(5, 49)
            self.flip_mixer = Mixer(2, 1)
        self.B1, self.B2 = bits_of(25), bits_of(12)
        self.diagonal_mixer = Mixer(2, 1)
        self.C1, self.C2 = bits_of(144), bits_of(45)
        self.D = bits_of(12)
        self.has_centres, self.centre = bits_of(2)
        self.split_mean = 0
        self.whole_mean = 0

    def read(self, decoder, mesh, P):
        """The split of a parent level (mesh) with positions P."""
        self.decoder, self.mesh, self.P = decoder, mesh, P
        self.read_edges()
        any_centres = bit(decoder, self.has_centres, 255)
        self.read_faces()
        split = Split()
        split.centre = [NONE] * mesh.faces
        if any_centres:
            self.read_centres(split.centre)
        split.child, split.splits, split.special = self.child, self.splits, self.special
        split.diagonal, split.flips = self.diagonal, self.flips
        split.origin, split.parents = self.origin, self.parents
        return split

    def len(self, u, v):
        return quarters(dist2(self.P[u], self.P[v]))

    # 1. Edges (D1)

    def read_edges(self):
        mesh = self.mesh
        V, opp, next_, prev = mesh.V, mesh.opp, mesh.next, mesh.prev
        self.child = [NONE] * len(V)
        self.known = [None] * len(V)                        # of the edge that corner c faces: 1 split, 0 whole
        self.known_split = [0] * mesh.vertices
        self.known_whole = [0] * mesh.vertices
        self.origin = []
        self.parents = []
        if self.rich:
            self.prepare_rich()
        for c in range(len(V)):
            d = opp[c]
            if d != NONE and d < c:
                continue
            a, b = V[next_[c]], V[prev[c]]
            value = self.read_edge(c, d, a, b)
            self.known[c] = value
            if d != NONE:
                self.known[d] = value
            for v in a, b:
                if value:
                    self.known_split[v] += 1
                else:
                    self.known_whole[v] += 1
            if value:
                m = mesh.vertices + len(self.origin)
                self.origin.append((c, NONE))
                self.parents.append((a, b))
                self.child[c] = m
                if d != NONE:
                    self.child[d] = m

    def state(self, c):
        if c == NONE:
            return STATE_NO_FACE
        others = (self.known[self.mesh.next[c]], self.known[self.mesh.prev[c]])
        return STATE[others.count(1), others.count(0)]

    def ends(self, v):
        return 4 * min(3, self.known_split[v]) + min(3, self.known_whole[v])

    def read_edge(self, c, d, a, b):
        mesh = self.mesh
        l = mesh.V[c]
        o = mesh.V[d] if d != NONE else NONE
        own = self.len(a, b)
        if o != NONE:
            around = (self.len(a, l) + self.len(b, l) + self.len(a, o) + self.len(b, o)) // 4
            across = ratio(self.len(l, o) - own - 4)
        else:
            around = (self.len(a, l) + self.len(b, l)) // 2
            across = 0
        r = ratio(own - around)
        f1, f2 = sorted((self.state(c), self.state(d)))
        va, vb = sorted((mesh.vclass(a), mesh.vclass(b)))
        vl, vo = sorted((mesh.vclass(l), mesh.vclass(o) if o != NONE else 0))
        ea, eb = sorted((self.ends(a), self.ends(b)))
        fs = 7 * f1 + f2
        m1 = self.A1[(fs * 5 + min(vl, 4)) * 5 + min(vo, 4)]
        m3 = self.A3[((va * 6 + vb) * 6 + vl) * 6 + vo]
        m4 = self.A4[(ea * 16 + eb) * 3 + (f1 >= 3) + (f2 >= 3)]
        if not self.rich:
            m2 = self.A2[r * 49 + fs]
            m5 = self.A5[(r * 12 + across) * 9 + ((f1 // 2) % 3) * 3 + (f2 // 2) % 3]
            return self.split_mixer.mix(self.decoder, (m1, m2, m3, m4, m5), fs)

        guesses, count = self.guesses, self.count
        threshold = self.level_mean + ((self.split_mean + self.whole_mean) >> 1)
        total = 4 * (threshold >> 8) + 4 * (guesses[a] + guesses[b]) + guesses[l]
        number = 4 + 4 * (count[a] + count[b]) + count[l]
        if o != NONE:
            total += guesses[o]
            number += count[o]
        parting = max(total, 0) // number
        global_ = class_((256 * own - threshold) >> 8, -8, 7)
        local = class_((8 * own - self.mean[a] - self.mean[b]) >> 3, -10, 9)
        excess = class_(own - parting, -10, 10)
        o1, o2 = sorted((self.pair(c, parting), self.pair(d, parting) if d != NONE else 21))
        models = (m1, m3, m4, self.A6[global_ * 49 + fs], self.A7[local * 49 + fs], self.A8[global_ * 20 + local],
                  self.A9[excess * 12 + r], self.A10[(o1 * 22 + o2) * 21 + excess])
        value = self.split_mixer.mix(self.decoder, models, fs, 180)
        if value:
            self.split_mean += (256 * own - self.level_mean - self.split_mean) >> 6
        else:
            self.whole_mean += (256 * own - self.level_mean - self.whole_mean) >> 6
        for v in a, b:
            if count[v] < 64:
                guesses[v] += own - (5 if value else 1)
                count[v] += 1
        return value

    def prepare_rich(self):
        """Before the first edge of a level of a rich file."""
        mesh = self.mesh
        V = mesh.V
        self.length = [self.len(V[mesh.next[c]], V[mesh.prev[c]]) for c in range(len(V))]
        total = [0] * mesh.vertices
        edges = 0
        sum_of_all = 0
        for c in range(len(V)):
            if mesh.opp[c] != NONE and mesh.opp[c] < c:
                continue
            edges += 1
            sum_of_all += self.length[c]
            total[V[mesh.next[c]]] += self.length[c]
            total[V[mesh.prev[c]]] += self.length[c]
        self.level_mean = (256 * sum_of_all) // edges if edges else 0
        self.mean = [(4 * t + n // 2) // n if n else 0 for t, n in zip(total, mesh.valence)]
        self.guesses = [0] * mesh.vertices
        self.count = [0] * mesh.vertices

    def pair(self, c, parting):
        x, y = sorted((self.outer(self.mesh.next[c], parting), self.outer(self.mesh.prev[c], parting)))
        return y * (y + 1) // 2 + x

    def outer(self, k, parting):
        if self.known[k] is not None:
            return 4 if self.known[k] == 1 else 5
        e = self.length[k] - parting
        return (e >= -4) + (e >= 0) + (e >= 4)

    # 3. Faces (D2, D3)

    def read_faces(self):
        mesh = self.mesh
        self.splits = []
        self.special = []
        for f in range(mesh.faces):
            corners = (3 * f, 3 * f + 1, 3 * f + 2)
            is_split = [self.child[c] != NONE for c in corners]
            s = sum(is_split)
            self.splits.append(s)
            if s == 1:
                self.special.append(3 * f + is_split.index(True))
            elif s == 2:
                self.special.append(3 * f + is_split.index(False))
            else:
                self.special.append(3 * f)
        self.diagonal = [0] * mesh.faces
        self.flips = []
        self.in_flip = [False] * mesh.faces
        if self.rich:
            self.prepare_half()
        for f in range(mesh.faces):
            if self.splits[f] == 2:
                self.read_diagonal(f)
            elif self.splits[f] == 1:
                self.read_flip(f)

    def prepare_half(self):
        mesh = self.mesh
        half = [2 * mesh.valence[v] + (4 if mesh.boundary[v] else 0) for v in range(mesh.vertices)]
        half += [6 if mesh.opp[c] == NONE else 0 for c, _ in self.origin]
        for f in range(mesh.faces):
            s = self.splits[f]
            c0 = self.special[f]
            for c in range(3 * f, 3 * f + 3):
                if self.child[c] != NONE:
                    half[self.child[c]] += 3 + s
            if s == 1:
                half[mesh.V[c0]] += 2
            if s == 2:
                half[mesh.V[mesh.next[c0]]] += 1
                half[mesh.V[mesh.prev[c0]]] += 1
        self.half = half

    def read_diagonal(self, f):
        mesh, P = self.mesh, self.P
        c0 = self.special[f]
        c1, c2 = mesh.next[c0], mesh.prev[c0]
        v0, v1, v2 = mesh.V[c0], mesh.V[c1], mesh.V[c2]
        d1 = middle_distance(P[v1], P[v0], P[v2])
        d2 = middle_distance(P[v2], P[v0], P[v1])
        models = (self.B1[class_(mesh.valence[v1] - mesh.valence[v2], -2, 2) * 5
                          + min((mesh.vclass(v1) + mesh.vclass(v2)) // 2, 4)],
                  self.B2[ratio(d2 - d1)])
        value = self.diagonal_mixer.mix(self.decoder, models, 0)
        self.diagonal[f] = 1 if value else 2
        if self.rich:
            x = 1 if value else -1
            self.half[v1] += x
            self.half[self.child[c1]] += x
            self.half[v2] -= x
            self.half[self.child[c2]] -= x

    def can(self, f, e):
        mesh = self.mesh
        if mesh.opp[e] == NONE:
            return False
        g = mesh.opp[e] // 3
        if self.in_flip[f] or self.in_flip[g]:
            return False
        for other in mesh.next[e], mesh.prev[e]:
            if mesh.opp[other] != NONE and mesh.opp[other] // 3 == g:
                return False
        return self.splits[g] <= 1

    def far(self, e):
        o = self.mesh.opp[e]
        g = o // 3
        if self.splits[g] == 1:
            return self.child[self.special[g]]
        return self.mesh.V[o]

    def read_flip(self, f):
        mesh, P, V = self.mesh, self.P, self.mesh.V
        c0 = self.special[f]
        sides = (mesh.next[c0], mesh.prev[c0])
        c1, c2 = sides
        n0 = V[c0]
        m = self.child[c0]
        can = [self.can(f, e) for e in sides]
        if not any(can):
            return
        g, part, h = [0, 0], [0, 0], [0, 0]
        for i in 0, 1:
            if not can[i]:
                continue
            e = sides[i]
            n, p = V[mesh.next[e]], V[mesh.prev[e]]
            g[i] = ratio(self.len(n, p) + 8 - middle_distance(P[V[mesh.opp[e]]], P[V[c1]], P[V[c2]]))
            part[i] = 1 + self.splits[mesh.opp[e] // 3]
            if self.rich:
                half = self.half
                h[i] = 1 + class_((half[n] + half[p] - half[m] - half[self.far(e)]) >> 1, -4, 7)
        models = [self.C1[max(g) * 12 + min(g)], self.C2[(part[0] * 3 + part[1]) * 5 + min(mesh.vclass(n0), 4)]]
        if self.rich:
            models.append(self.C3[class_(self.half[m], 8, 15) * 13 + class_(self.half[n0], 8, 20)])
            models.append(self.C4[max(g) * 13 + max(h)])
        if self.flip_mixer.mix(self.decoder, models, 0) == 0:
            return
        if all(can):
            which = bit(self.decoder, self.D[ratio(g[1] - g[0])], 255)
        else:
            which = can.index(True)
        e = sides[which]
        self.flips.append(e)
        self.in_flip[f] = True
        self.in_flip[mesh.opp[e] // 3] = True
        if self.rich:
            self.half[V[mesh.next[e]]] -= 2
            self.half[V[mesh.prev[e]]] -= 2
            self.half[m] += 2
            self.half[self.far(e)] += 2

    # 4. Centres, continued

    def read_centres(self, centre):
        mesh = self.mesh
        for f in range(mesh.faces):
            if self.splits[f] == 0 and not self.in_flip[f] and bit(self.decoder, self.centre, 255) == 1:
                centre[f] = mesh.vertices + len(self.origin)
                self.origin.append((NONE, f))
                self.parents.append(tuple(mesh.V[3 * f:3 * f + 3]))


# 8.2 Refinement

DESCENDANTS = {                             # by number of split edges and diagonal; "centre"
    (0, 0): ((0, 1, 2),),
    "centre": ((6, 1, 2), (6, 2, 0), (6, 0, 1)),
    (1, 0): ((0, 1, 3), (0, 3, 2)),
    (2, 1): ((0, 5, 4), (5, 1, 4), (4, 1, 2)),
    (2, 2): ((0, 5, 4), (5, 1, 2), (5, 2, 4)),
    (3, 0): ((0, 5, 4), (1, 3, 5), (2, 4, 3), (3, 4, 5)),
}


def refine(mesh, split):
    """The triangles of the finer level."""
    V = mesh.V
    triangles = []
    first = []                                              # of the descendants of face f
    for f in range(mesh.faces):
        first.append(len(triangles))
        c0 = split.special[f]
        corners = (c0, mesh.next[c0], mesh.prev[c0])
        points = [V[c] for c in corners] + [split.child[c] for c in corners] + [split.centre[f]]
        kind = "centre" if split.centre[f] != NONE else (split.splits[f], split.diagonal[f])
        for t in DESCENDANTS[kind]:
            triangles.append([points[i] for i in t])
    first.append(len(triangles))

    def descendant(f, start, to):
        """the descendant of f with this directed edge, and its third vertex"""
        for t in triangles[first[f]:first[f + 1]]:
            for i in range(3):
                if t[i] == start and t[(i + 1) % 3] == to:
                    return t, t[(i + 2) % 3]
        raise corrupt("a flip of no edge")

    for e in split.flips:
        n, p = V[mesh.next[e]], V[mesh.prev[e]]
        one, m = descendant(e // 3, n, p)
        two, x = descendant(mesh.opp[e] // 3, p, n)
        one[one.index(p)] = x
        two[two.index(n)] = m
    return triangles


# 8.3 Details

ROWS = (3, 150, 1156, 1326, 525, 714)       # R1..R6


def mclass(n):
    return min(quarters(n + 1) // 2, 33)


class Details:
    def __init__(self):
        self.rows = [[None] * n for n in ROWS]
        self.mixer = Mixer(6, 130)
        self.mag = {}                       # 0 for the vertices of the base mesh

    def row(self, table, index):
        if self.rows[table][index] is None:
            self.rows[table][index] = bits_of(130)
        return self.rows[table][index]

    def read(self, decoder, mesh, P, split):
        """The details of all new vertices, and whether all arrived: from where the decoder is exhausted on, they
        are 0."""
        details = []
        try:
            for m in range(len(split.origin)):
                c, f = split.origin[m]
                if c != NONE:
                    context = self.edge_context(mesh, P, split, mesh.vertices + m, c)
                else:
                    a, b = P[mesh.V[3 * f]], P[mesh.V[3 * f + 1]]
                    context = (min(quarters(dist2(a, b)) // 4, 49), 0, 0, (10, 10, 10))
                detail = self.read_detail(decoder, *context)
                details.append(detail)
                self.mag[mesh.vertices + m] = min(sum(abs(x) for x in detail), 0xFFFFFFFF)
        except Exhausted:
            missing = len(split.origin) - len(details)
            return details + [(0, 0, 0)] * missing, False
        return details, True

    def edge_context(self, mesh, P, split, m, c):
        V, opp = mesh.V, mesh.opp
        d = opp[c]
        a, b = V[mesh.next[c]], V[mesh.prev[c]]
        length = min(quarters(dist2(P[a], P[b])) // 4, 49)
        born = mclass((self.mag.get(a, 0) + self.mag.get(b, 0)) // 2)
        wings = [mesh.next[c], mesh.prev[c]]
        if d != NONE:
            wings += [mesh.next[d], mesh.prev[d]]
        siblings = [split.child[e] for e in wings if split.child[e] != NONE and split.child[e] < m]
        near = 0
        if siblings:
            near = 1 + min(mclass(sum(self.mag[s] for s in siblings) // len(siblings)), 32)
        beyond = [opp[e] for e in wings]
        offset = []
        for k in range(3):
            t = 0
            if d != NONE and NONE not in beyond:
                t = 2 * (P[V[c]][k] + P[V[d]][k]) - sum(P[V[e]][k] for e in beyond)
            s = min(bitlen(abs(t) >> 2), 10)
            offset.append(10 - s if t < 0 else 10 + s)
        return length, born, near, offset

    def read_detail(self, decoder, length, born, near, offset):
        detail = []
        for axis in range(3):
            other = near if axis == 0 else mclass(sum(abs(x) for x in detail))
            indices = (axis, axis * 50 + length, near * 34 + born, (axis * 34 + other) * 13 + length // 4,
                       offset[axis] * 25 + length // 2, offset[axis] * 34 + near)
            rows = [self.row(i, indices[i]) for i in range(6)]
            detail.append(self.read_coordinate(decoder, rows))
        return tuple(detail)

    def read_coordinate(self, decoder, rows):
        def node(i):
            return self.mixer.mix(decoder, [row[i] for row in rows], i)

        if node(0) == 1:
            return 0
        negative = node(1)
        n = 1
        while n < 31 and node(2 + n) == 1:
            n += 1
        x = 1
        if n >= 2:
            x = 2 * x + node(34 + n)
        if n >= 3:
            x = 2 * x + node(66 + 2 * n + (x & 1))
        for _ in range(n - 3):
            x = 2 * x + decoder.decode(32768)
        return -x if negative else x


# ----------------------------------------------------------------------------------------------------------------
# 9. Synthesis
# ----------------------------------------------------------------------------------------------------------------

def synthesis(mesh, P, split, details, lifting, glue):
    """The positions of the finer level."""
    P = [list(p) for p in P]
    if lifting >= 0:
        lifting_weights = LiftingWeights(mesh, split, lifting)
        sums = {}
        for m in range(len(split.origin)):
            if split.origin[m][0] == NONE:
                continue
            for v, alpha in lifting_weights.of(split.origin[m][0]):
                if glue and glue.shared(v):
                    continue
                s = sums.setdefault(v, [0, 0, 0])
                for k in range(3):
                    s[k] += alpha * details[m][k]
        for v, s in sums.items():
            P[v] = [wrap32(P[v][k] - (wrap64(s[k]) >> 16)) for k in range(3)]
    for m in range(len(split.origin)):
        parents = [P[v] for v in split.parents[m]]
        if len(parents) == 2:
            predicted = [(x + y + 1) >> 1 for x, y in zip(*parents)]
        else:
            predicted = [ceil_div(x + y + z, 3) for x, y, z in zip(*parents)]
        P.append([wrap32(details[m][k] + predicted[k]) for k in range(3)])
    return [tuple(p) for p in P]


class LiftingWeights:
    def __init__(self, mesh, split, discs):
        self.mesh = mesh
        self.split = split
        self.discs = discs
        self.weight = [3 if split.centre[f] != NONE else 1 + split.splits[f] for f in range(mesh.faces)]
        self.rows = {}

    def of(self, c):
        """The weights of the child on the edge of corner c: entries (vertex, alpha)."""
        H = self.support(c)
        return self.solve(H, self.products_of_child(c)) if H else []

    def support(self, c):
        """9.1; None if a valence is too great"""
        mesh = self.mesh
        H = [mesh.V[mesh.next[c]], mesh.V[mesh.prev[c]]]
        if any(mesh.valence[v] > 256 for v in H):
            return None
        i = 0
        for _ in range(self.discs):
            end = len(H)
            while i < end:
                for u in mesh.ring(H[i]):
                    if mesh.valence[u] > 256:
                        return None
                    if u not in H and len(H) < 48:
                        H.append(u)
                i += 1
        return H

    def row(self, v):
        """9.2: I[v], but for zeros"""
        if v not in self.rows:
            mesh = self.mesh
            row = {v: 0}
            for c in mesh.corners[v]:
                w = self.weight[c // 3]
                row[v] += 2 * w
                for u in mesh.V[mesh.next[c]], mesh.V[mesh.prev[c]]:
                    row[u] = row.get(u, 0) + w
            self.rows[v] = row
        return self.rows[v]

    def products_of_child(self, c):
        """9.3: t, but for zeros"""
        mesh, split = self.mesh, self.split
        t = {}
        for corner in c, mesh.opp[c]:
            if corner == NONE:
                continue
            f = corner // 3
            if split.splits[f] == 1:
                numbers = (6, 6, 4)
            elif split.splits[f] == 3:
                numbers = (10, 10, 4)
            elif corner == mesh.next[split.special[f]]:
                numbers = (8, 10, 6) if split.diagonal[f] == 1 else (6, 8, 2)
            else:
                numbers = (8, 6, 2) if split.diagonal[f] == 1 else (10, 8, 6)
            for e, number in zip((mesh.next[corner], mesh.prev[corner], corner), numbers):
                t[mesh.V[e]] = t.get(mesh.V[e], 0) + number
        return t

    def solve(self, H, t):
        """9.4"""
        n = len(H)
        I = [self.row(v) for v in H]
        N = [[sum(x * I[j].get(u, 0) for u, x in I[i].items()) for j in range(n)] for i in range(n)]
        r = [sum(x * t.get(u, 0) for u, x in I[i].items()) for i in range(n)]
        others = [[(j, N[i][j]) for j in range(n) if j != i and N[i][j] != 0] for i in range(n)]
        x = [0] * n
        for _ in range(16):
            for i in range(n):
                x[i] = trunc_div(r[i] * 65536 - sum(w * x[j] for j, w in others[i]), N[i][i])
        return [(H[i], x[i] >> 1) for i in range(n)]


# ----------------------------------------------------------------------------------------------------------------
# 10. What comes out
# ----------------------------------------------------------------------------------------------------------------

def model_position(head, P):
    """10.1, of a lattice point (integers, or exact sixteenths)"""
    return tuple(head.origin[k] + head.step * P[k] for k in range(3))


def error_figure(head, i):
    """10.2"""
    e = head.error[i]
    if e < 4:
        return head.step * sqrt(e / 256)
    return head.step * sqrt((4 + (e & 3)) * 2.0 ** ((e >> 2) - 1) / 256)


def lattice_digest(positions, corners):
    """10.3"""
    data = [struct.pack("<3I", *(x & 0xFFFFFFFF for x in p)) for p in positions]
    data.append(struct.pack("<%dI" % len(corners), *corners))
    return xxh32(b"".join(data))


# ----------------------------------------------------------------------------------------------------------------
# 13.2 Logarithms, odds, unit vectors
# ----------------------------------------------------------------------------------------------------------------

def make_log_table():
    table = []
    for i in range(1024):
        x = (1024 + i) << 20
        T = 0
        for _ in range(12):
            x = (x * x) >> 30
            T = 2 * T + (x >> 31)
            x = x >> (x >> 31)
        table.append(T)
    return table


LOG_TABLE = make_log_table()
EXP_TABLE = (4096, 4466, 4870, 5311, 5792, 6316, 6888, 7512)


def log2f(x):
    L = x.bit_length()
    m = x >> (L - 11) if L > 11 else x << (11 - L)
    return 4096 * (L - 1) + LOG_TABLE[m & 1023]


def log8(x):
    return log2f(x) >> 9


def exp8(e):
    return (EXP_TABLE[e & 7] << ((e >> 3) + 10)) >> 10


def odds(a, b):
    x = ((log2f(a) - log2f(b)) * 177) >> 12
    return -2047 if x < -2047 else 2047 if x > 2047 else x


def add(a, b):
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def shifted(a, n):
    """a >> n"""
    return (a[0] >> n, a[1] >> n, a[2] >> n)


def norm1(a):
    return abs(a[0]) + abs(a[1]) + abs(a[2])


ZERO = (0, 0, 0)


def normalised(n):
    L = bitlen(max(abs(x) for x in n))
    if L == 0:
        return ZERO
    v = [x >> (L - 15) if L > 15 else x << (15 - L) for x in n]
    r = isqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2])
    return tuple(trunc_div(x * 16384, r) for x in v)


def along(a, n):
    return (a[0] * n[0] + a[1] * n[1] + a[2] * n[2]) >> 14


def cross(a, b):
    a = [clamp(x, -1048575, 1048575) for x in a]
    b = [clamp(x, -1048575, 1048575) for x in b]
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def mean(vectors):
    """mean(S, n) of n vectors"""
    n = len(vectors)
    if n == 0:
        return ZERO
    f = 65536 // n
    return tuple((sum(v[k] for v in vectors) * f + 32768) >> 16 for k in range(3))


# ----------------------------------------------------------------------------------------------------------------
# 13.3 The surface around
# ----------------------------------------------------------------------------------------------------------------

def around(mesh, x):
    result = []
    for v in range(mesh.vertices):
        corners = mesh.corners[v]
        if not corners:
            result.append(ZERO)
            continue
        S = [0, 0, 0]
        for c in corners:
            for u in mesh.V[mesh.next[c]], mesh.V[mesh.prev[c]]:
                for k in range(3):
                    S[k] += x[u][k]
        n = 2 * len(corners)
        result.append(tuple(trunc_div(S[k], n) - x[v][k] for k in range(3)))
    return result


def normals(mesh, p):
    total = [ZERO] * mesh.vertices
    for f in range(mesh.faces):
        a, b, c = mesh.V[3 * f:3 * f + 3]
        n = cross(sub(p[b], p[a]), sub(p[c], p[a]))
        for v in a, b, c:
            total[v] = add(total[v], n)
    return [normalised(n) for n in total]


def likely(mesh, cells, b, glue):
    middle = [tuple((16 * x << b) + 8 * ((1 << b) - 1) for x in cell) for cell in cells]
    if b == 0:
        return middle
    normal = normals(mesh, middle)
    bend = around(mesh, around(mesh, middle))               # of the laplacian; B is its negative
    r = 8 * ((1 << b) - 1)
    result = []
    for v in range(mesh.vertices):
        if glue and glue.shared(v):
            result.append(middle[v])
            continue
        B = tuple(-x for x in bend[v])
        t = along(B, normal[v])
        result.append(tuple(middle[v][k] + clamp((t * normal[v][k]) >> 15, -r, r) for k in range(3)))
    return result


# ----------------------------------------------------------------------------------------------------------------
# 13.14 Where a level is shown
# ----------------------------------------------------------------------------------------------------------------

def shown(mesh, cells, s, parents, bits, glue):
    """parents of the vertices that the last split brought; none: smoothed only"""
    middle = [tuple((16 * x << s) + 8 * ((1 << s) - 1) for x in cell) for cell in cells]
    r = 8 * ((1 << s) - 1)

    def normals_of(L):
        return normals(mesh, [shifted(p, max(0, bits - 16)) for p in L])

    def smooth(L, g):
        n = normals_of(L)
        bend = around(mesh, around(mesh, L))                # of the laplacian; B is its negative
        e = max(0, s - 8)
        R = r >> e
        w = [along(tuple(-x for x in bend[v]), n[v]) >> e for v in range(mesh.vertices)]
        a = sum(abs(x) < R for x in w)
        Q = min(16 * a // (mesh.vertices - a + 1), 44)
        S = max(1, (5 * Q ** 3 * R * R) >> 12)
        result = []
        for v in range(mesh.vertices):
            if glue and glue.shared(v):
                result.append(middle[v])
                continue
            W = (g * trunc_div(S * w[v], S + w[v] * w[v])) << e
            result.append(tuple(m + clamp(L[v][k] + ((W * n[v][k]) >> 16) - m, -r, r)
                                for k, m in enumerate(middle[v])))
        return result

    if not parents:
        return smooth(smooth(middle, 3), 3)
    L = smooth(middle, 2)
    n = normals_of(L)

    def g(u, v):
        """the height, or None if the pair is steep"""
        way = sub(L[v], L[u])
        height = sum(way[k] * (n[v][k] - n[u][k]) for k in range(3)) >> 17
        return None if height * height > sum(x * x for x in way) >> 7 else height

    q = max(0, bits - 12)
    A = B = 0
    for i, pair in enumerate(parents):
        if len(pair) != 2:
            continue
        x = mesh.vertices - len(parents) + i
        a, b = pair
        guess = (g(a, b) or 0) >> q
        height = sum((2 * L[x][k] - L[a][k] - L[b][k]) * (n[a][k] + n[b][k]) for k in range(3)) >> (16 + q)
        A += height * guess
        B += guess * guess
    D = 2 * A - B
    pairs = [g(mesh.V[c], mesh.V[mesh.next[c]]) for c in range(len(mesh.V))]
    if D <= 0 or 4 * pairs.count(None) > len(pairs):
        return L
    h = max(0, bitlen(B) - 40)
    t = min(256, ((D >> h) * 256) // (B >> h))
    result = []
    for v in range(mesh.vertices):
        around_v = [u for c in mesh.corners[v] for u in (mesh.V[mesh.next[c]], mesh.V[mesh.prev[c]])]
        if not around_v or glue and glue.shared(v):
            result.append(L[v])
            continue
        G = trunc_div(sum(g(v, u) or 0 for u in around_v), len(around_v))
        result.append(tuple(m + clamp(L[v][k] + ((t * G * n[v][k]) >> 22) - m, -r, r)
                            for k, m in enumerate(middle[v])))
    return result


# ----------------------------------------------------------------------------------------------------------------
# 13.4 Walk
# ----------------------------------------------------------------------------------------------------------------

def walk(mesh):
    V, opp = mesh.V, mesh.opp
    visited = [False] * mesh.faces
    seen = [False] * mesh.vertices
    order = []
    ready, waiting = [], deque()

    def see(v):
        if not seen[v]:
            seen[v] = True
            order.append(v)

    for f in range(mesh.faces):
        if visited[f]:
            continue
        visited[f] = True
        for c in range(3 * f, 3 * f + 3):
            see(V[c])
        waiting.extend(range(3 * f, 3 * f + 3))
        while ready or waiting:
            c = ready.pop() if ready else waiting.popleft()
            d = opp[c]
            if d == NONE or visited[d // 3]:
                continue
            visited[d // 3] = True
            see(V[d])
            for e in mesh.next[d], mesh.prev[d]:
                o = opp[e]
                if o == NONE or visited[o // 3]:
                    continue
                if seen[V[o]]:
                    ready.append(e)
                else:
                    waiting.append(e)
    return order


# ----------------------------------------------------------------------------------------------------------------
# 13.8 Shapes
# ----------------------------------------------------------------------------------------------------------------

def bin_of(u):
    """bin, part and w of |u|"""
    if u < 128:
        return u >> 3, u & 7, 3
    x = min(u, 2097151)
    o = x.bit_length() - 8
    w = o + 5
    return 16 + 4 * o + ((x >> w) & 3), x & ((1 << w) - 1), w


def first_counts():
    side = []
    for b in range(72):
        if b < 16:
            W, e = 8, 8 * b
        else:
            o = (b - 16) // 4
            W = 1 << (o + 5)
            e = (4 + ((b - 16) & 3)) * W
        h = e + W // 2
        side.append(1 + (W * 163840) // (4096 + 2 * h * h))
    return side[::-1] + side


FIRST_COUNTS = first_counts()


class Shape:
    __slots__ = ("counts", "cumulative", "pending", "wait")

    def __init__(self):
        self.counts = FIRST_COUNTS[:]
        self.rebuild()
        self.pending = 0
        self.wait = 2

    def rebuild(self):
        if sum(self.counts) > 128000:
            self.counts = [c - (c >> 1) for c in self.counts]
        f = ((1048576 - 576) << 24) // sum(self.counts)
        R = 0
        self.cumulative = [0]
        for i, c in enumerate(self.counts):
            R += c
            self.cumulative.append(((R * f) >> 24) + 4 * (i + 1))

    def below(self, u):
        if u >= 0:
            b, part, w = bin_of(u)
            start, to = self.cumulative[72 + b], self.cumulative[73 + b]
            return start + (((to - start) * part) >> w)
        b, part, w = bin_of(-u)
        start, to = self.cumulative[71 - b], self.cumulative[72 - b]
        return to - (((to - start) * part) >> w)

    def learn(self, u):
        b = bin_of(abs(u))[0]
        self.counts[72 + b if u >= 0 else 71 - b] += 64
        self.pending += 1
        if self.pending >= self.wait:
            self.wait = min(self.wait + self.wait // 2 + 1, 128)
            self.pending = 0
            self.rebuild()


# ----------------------------------------------------------------------------------------------------------------
# 13.9 Mixing
# ----------------------------------------------------------------------------------------------------------------

QUARTER_OCTAVES = (65536, 77936, 92682, 110218)             # Q
INVERSE = [(1 << 42) // (QUARTER_OCTAVES[c & 3] << (c >> 2)) for c in range(96)]        # I


class MixingSet:
    __slots__ = ("w", "seen")

    def __init__(self, first):
        self.w = [first] * 16
        self.seen = 0


class Mixing:
    """Weights and refinement."""

    def __init__(self, first):
        self.sets = [[[MixingSet(first) for _ in range(12)] for _ in range(21)] for _ in range(3)]
        self.E = [[64 * squash(128 * i - 2048) for i in range(33)] for _ in range(21)]


class ValueReader:
    """Reads one coordinate. opinions: (centre, scale, shape); contexts: (A, B, C); values: the sorted list of the
    axis' values coded so far, or None if counts are not used."""

    def __init__(self, decoder, mixing, opinions, contexts, values):
        self.decoder = decoder
        self.mixing = mixing
        self.centres = [o[0] for o in opinions]
        self.inverses = [INVERSE[o[1]] for o in opinions]
        self.shapes = [o[2] for o in opinions]
        self.contexts = contexts
        self.values = values

    def F(self, t):
        """of all opinions"""
        x = 16 * t - 8
        return [shape.below(((x - centre) * inverse) >> 20)
                for shape, centre, inverse in zip(self.shapes, self.centres, self.inverses)]

    def count(self, a, b):
        return bisect_left(self.values, b) - bisect_left(self.values, a)

    def question(self, t, k):
        """X >= t?"""
        if t <= self.low:
            return True
        if t >= self.high:
            return False
        m = self.F(t)
        s = [odds((h - x if h > x else 0) + 3, (x - l if x > l else 0) + 3)
             for l, x, h in zip(self.lowF, m, self.highF)]
        if self.values is None:
            s.append(0)
        else:
            s.append(odds(16 * self.count(t, self.high) + 6, 16 * self.count(self.low, t) + 6))
        sets = [self.mixing.sets[j][k][self.contexts[j]] for j in range(3)]
        d_j = [clamp(sum([x * w for x, w in zip(s, one.w)]) >> 16, -2047, 2047) for one in sets]
        d = trunc_div(sum(d_j), 3)
        x = (d + 2048) * 32
        i = x >> 12
        r = x & 4095
        E = self.mixing.E[k]
        q = (E[i] * (4096 - r) + E[i + 1] * r) >> 18
        answer = self.decoder.decode(clamp((squash(d) + q) // 2, 24, 65512))
        for j in range(3):
            one = sets[j]
            rate = 20 + 3000 // (one.seen + 48)
            e = ((65535 if answer else 0) - squash(d_j[j])) * rate
            if one.seen < 1024:
                one.seen += 1
            one.w[:len(s)] = [clamp(w + ((y * e + 524288) >> 20), -524287, 524287) for w, y in zip(one.w, s)]
        near = i if r < 2048 else i + 1
        E[near] += trunc_div((4194303 if answer else 0) - E[near], 64)
        if answer:
            self.low, self.lowF = t, m
        else:
            self.high, self.highF = t, m
        return answer == 1

    def around(self, low, high, guide, spread):
        n = len(self.shapes)
        self.low, self.high = low, high
        self.lowF, self.highF = [0] * n, [1 << 20] * n
        up = self.question(guide, 0)
        depth = 1
        while True:
            reach = 1 << (spread + depth - 1)
            t = guide + reach if up else guide - reach
            if t <= low or t >= high or self.question(t, min(depth, 6)) != up:
                break
            depth += 1
        while self.high - self.low > 1:
            self.question(self.low + (self.high - self.low) // 2, 7 + min(bitlen(self.high - self.low - 1), 8))
        return self.finish()

    def within(self, low, b):
        self.low, self.high = low, low + (1 << b)
        self.lowF, self.highF = self.F(self.low), self.F(self.high)
        while self.high - self.low > 1:
            self.question(self.low + (self.high - self.low) // 2, 16 + min(bitlen(self.high - self.low - 1), 4))
        return self.finish()

    def finish(self):
        for shape, centre, inverse in zip(self.shapes, self.centres, self.inverses):
            shape.learn(((16 * self.low - centre) * inverse) >> 20)
        return self.low


# ----------------------------------------------------------------------------------------------------------------
# 13.10 Least squares
# ----------------------------------------------------------------------------------------------------------------

class LeastSquares:
    def __init__(self, N):
        self.N = N
        self.W = [0] * N
        self.G = [[1 << 20 if i == k else 0 for k in range(N)] for i in range(N)]
        self.M = [0] * N
        self.odd = 0

    def predict(self, f):
        return sum(w * x for w, x in zip(self.W, f)) >> 14

    def observe(self, f, y, importance):
        for i in range(self.N):
            for k in range(i, self.N):
                self.G[i][k] += (importance * f[i] * f[k]) >> 6
                self.G[k][i] = self.G[i][k]
            self.M[i] += (importance * f[i] * y) >> 6

    def end(self):
        self.odd = 1 - self.odd
        if self.odd == 1:
            return
        for i in range(self.N):
            self.G[i] = [g - (g >> 7) for g in self.G[i]]
            self.M[i] -= self.M[i] >> 7
        for i in range(self.N):
            row = self.G[i]
            rest = sum(g * w for g, w in zip(row, self.W)) - row[i] * self.W[i]
            self.W[i] = clamp(trunc_div(self.M[i] * 16384 - rest, row[i] + 4096), -65536, 65536)


# ----------------------------------------------------------------------------------------------------------------
# 13.7 What is learned
# ----------------------------------------------------------------------------------------------------------------

class Learned:
    """`births` or `bits`"""

    def __init__(self, first_weight):
        self.shapes = [[Shape() for _ in range(3)] for _ in range(8)]                           # predictor, band
        self.repeats = [[[Shape() for _ in range(4)] for _ in range(3)] for _ in range(7)]      # repeat, axis, context
        self.mixing = Mixing(first_weight)
        self.ratio = [[-320] * 3 for _ in range(8)]             # 2..7 are used
        self.normal_ratio = [-320] * 2
        self.offset = [LeastSquares(7) for _ in range(4)]
        self.height = [LeastSquares(9) for _ in range(4)]


class Record:
    __slots__ = ("error", "normal_error", "repeated", "offset")

    def __init__(self):
        self.error = [[0] * 3 for _ in range(8)]
        self.normal_error = [0, 0]
        self.repeated = 0
        self.offset = ZERO


class Compact:
    """13: the positions of compact files. What lives until the file ends, and the coding of one refinement."""

    def __init__(self, head, glue):
        self.bits = head.bits
        self.glue = glue
        self.P = 5 if head.predictors == 0 else 8
        self.has_repeats = head.predictors == 2
        first_weight = 9830 if head.predictors == 0 else 6144
        self.births = Learned(first_weight)
        self.more = Learned(first_weight)                   # `bits`
        self.record = []
        self.values = None                                  # of each axis, sorted: what `count` counts

    def start(self, decoder, mesh, shift):
        self.decoder = decoder
        self.mesh = mesh                                    # where the ring is
        self.shift = shift
        while len(self.record) < mesh.vertices:
            self.record.append(Record())

    # 13.5 Positions after a split

    def read_split(self, decoder, parent, mesh, cells, split, shift):
        """The cells of the finer level, and whether all arrived."""
        self.start(decoder, mesh, shift)
        if self.has_repeats and shift == 0 and self.bits <= 16 and self.values is None:
            self.values = [sorted(cell[k] for cell in cells) for k in range(3)]
        self.is_birth = True
        self.learned = self.births
        self.N = N = parent.vertices
        self.parent, self.split = parent, split
        new = len(split.origin)
        self.cell = list(cells) + [None] * new
        self.known = [True] * N + [False] * new
        self.p = [tuple(16 * x for x in cell) for cell in cells] + [None] * new
        self.laplacian = around(parent, self.p[:N])
        self.normal = normals(parent, self.p[:N])
        whole = True
        try:
            for v in walk(mesh):
                if v >= N:
                    self.set_cell(v, self.code(v))
        except Exhausted:
            whole = False
            for v in range(N, mesh.vertices):
                if self.cell[v] is None:
                    parents = split.parents[v - N]
                    self.cell[v] = tuple(ceil_div(sum(cells[u][k] for u in parents), len(parents))
                                         for k in range(3))
        return self.cell, whole

    # 13.6 More bits

    def read_more_bits(self, decoder, mesh, cells, b, shift):
        """The cells after a precise refinement of b bits to `shift`, and whether all arrived."""
        self.start(decoder, mesh, shift)
        if self.has_repeats and shift == 0 and self.bits <= 16 and self.values is None:
            self.values = [[], [], []]
        self.is_birth = False
        self.learned = self.more
        self.N = 0
        self.b = b
        self.cell = list(cells)                             # the old ones, until known
        self.known = [False] * mesh.vertices
        self.p = likely(mesh, cells, b, self.glue)
        self.laplacian = around(mesh, self.p)
        self.normal = normals(mesh, self.p)
        coded = {}                                          # of each original: the vertex that was coded
        original = self.glue.first_of if self.glue else lambda v: v
        whole = True
        try:
            for v in walk(mesh):
                w = coded.get(original(v))
                if w is None:
                    self.set_cell(v, self.code(v))
                    coded[original(v)] = v
                else:                                       # glued, and put where w is when its turn comes
                    self.set_cell(v, self.cell[w])
                    self.record[v] = self.record[w]
        except Exhausted:
            if not coded:                                   # nothing new: the level before (11.2)
                raise
            whole = False
        for v in range(mesh.vertices):
            if not self.known[v]:
                w = coded.get(original(v))
                self.cell[v] = self.cell[w] if w is not None else tuple((q << b) + (1 << b) // 2 for q in cells[v])
        return self.cell, whole

    def set_cell(self, v, cell):
        self.cell[v] = cell
        self.p[v] = tuple(16 * x for x in cell)
        self.known[v] = True

    def code(self, v):
        """One vertex: its cell."""
        sight = self.look(v)
        cell = self.read_coordinates(v, sight)
        self.learn(v, sight, cell)
        return cell

    # 13.11 What a vertex sees

    def look(self, v):
        s = Sight()
        mesh, p, known, N = self.mesh, self.p, self.known, self.N
        self.find_ring(v, s)
        if self.is_birth:
            c, f = self.split.origin[v - N]
            s.parents = self.split.parents[v - N]
            s.a, s.b = s.parents[:2]
            total = [sum(p[u][k] for u in s.parents) for k in range(3)]
            s.origin = tuple(trunc_div(x, len(s.parents)) for x in total)
            s.length = norm1(sub(p[s.a], p[s.b])) + 16
        else:
            c = NONE
            s.origin = p[v]
            s.length = sum(norm1(sub(p[u], s.origin)) for u in s.ring) // len(s.ring) + 16
        origin = s.origin
        s.known = [u for u in s.ring if known[u]]
        s.experienced = [u for u in s.known if u >= N]      # the known u >= N

        known_ring = mean([sub(p[u], origin) for u in s.known])
        similar = mean([self.record[u].offset for u in s.experienced])
        known_ones, all_ones = self.parallelograms(v, s)
        s.g = g = len(known_ones)
        known_all = mean(known_ones)
        first = known_ones[0] if g > 0 else ZERO

        if self.is_birth:
            bend = shifted(add(self.laplacian[s.a], self.laplacian[s.b]), 1)            # of a centre, too
            far = wings = s.n = ZERO
            if c != NONE:
                s.n, far, wings = self.frame(c, s)
            features = (known_ring, known_all, first, similar, bend, far, wings)
            s.center = ZERO
            zero = shifted(sub(far, wings), 2)
            s.predictor = [[], [],                          # 0 and 1: axis by axis
                           zero,
                           known_ring,
                           shifted(known_all, 1),
                           known_all if g > 0 else zero,
                           similar if s.experienced else zero,
                           first if g > 0 else zero]
            s.class_ = min(g, 3) if c != NONE else 0
        else:
            s.n = self.normal[v]
            ring = mean([sub(p[u], origin) for u in s.ring])
            bent = mean([sub(sub(p[u], origin), self.laplacian[u]) for u in s.ring])
            all_ = mean(all_ones)
            if g == 0:
                known_all = first = all_
            features = (ring, all_, bent, known_all, similar, first, sub(self.laplacian[v], ring))
            s.center = ring
            s.predictor = [[], [],                          # 0 and 1: axis by axis
                           all_,
                           known_ring if s.known else ring,
                           tuple(trunc_div(4 * x - y, 3) for x, y in zip(ring, all_)),
                           known_all,
                           bent,
                           first]
            s.class_ = min(g, 3)

        s.set_scale(s.length)
        s.f = [[s.feature(x[k]) for x in features] for k in range(3)]
        s.h = [along((s.f[0][i], s.f[1][i], s.f[2][i]), s.n) for i in range(7)] + self.heights(s)
        s.plain = [clamp(self.learned.offset[s.class_].predict(s.f[k]), -122880, 122880) for k in range(3)]
        s.height = clamp(self.learned.height[s.class_].predict(s.h), -122880, 122880)
        lift = s.height - along(s.plain, s.n)
        s.best = tuple(s.up(s.plain[k] + ((lift * s.n[k]) >> 14)) for k in range(3))
        self.expected_errors(s)
        return s

    def find_ring(self, v, s):
        mesh = self.mesh
        s.corners = mesh.corners[v][:24]
        s.ring = [mesh.V[mesh.next[c]] for c in s.corners]
        if mesh.boundary[v] and len(s.corners) == len(mesh.corners[v]):
            s.ring.append(mesh.V[mesh.prev[s.corners[-1]]])

    def parallelograms(self, v, s):
        """the known ones and all"""
        mesh, p, known = self.mesh, self.p, self.known
        known_ones, all_ones = [], []
        for c in s.corners:
            o = mesh.opp[c]
            if o == NONE or mesh.V[o] == v:
                continue
            x, y, z = mesh.V[mesh.next[c]], mesh.V[mesh.prev[c]], mesh.V[o]
            is_known = known[x] and known[y] and known[z]
            if self.is_birth and not is_known:
                continue
            value = sub(sub(add(p[x], p[y]), p[z]), s.origin)
            all_ones.append(value)
            if is_known:
                known_ones.append(value)
        return known_ones, all_ones

    def frame(self, c, s):
        """n, far and wings of a birth on the edge of corner c of the parent level"""
        mesh, p = self.parent, self.p
        V, opp = mesh.V, mesh.opp
        d = opp[c]
        pa, pb, pl = p[s.a], p[s.b], p[V[c]]
        n = cross(sub(pb, pa), sub(pl, pa))
        if d == NONE:
            return normalised(n), ZERO, ZERO
        po = p[V[d]]
        n = add(n, cross(sub(po, pa), sub(pb, pa)))
        far = sub(shifted(add(pl, po), 1), s.origin)

        def beyond(e):
            if opp[e] != NONE:
                return p[V[opp[e]]]
            return sub(add(p[V[mesh.next[e]]], p[V[mesh.prev[e]]]), p[V[e]])

        total = ZERO
        for e in mesh.next[c], mesh.prev[c], mesh.next[d], mesh.prev[d]:
            total = add(total, beyond(e))
        return normalised(n), far, sub(shifted(total, 2), s.origin)

    def heights(self, s):
        """h_7, h_8"""
        H = W = H2 = W2 = 0
        for u in s.ring:
            if self.is_birth and u >= self.N:
                continue
            normal = self.normal[u]
            w = along(normal, s.n)
            if w < 4915:
                continue
            height = along(sub(self.p[u], s.origin), normal)
            H += height
            W += w
            if (u == s.a or u == s.b) if self.is_birth else self.known[u]:
                H2 += height
                W2 += w
        h7 = s.feature(trunc_div(H * 16384, W)) if W != 0 else 0
        h8 = s.feature(trunc_div(H2 * 16384, W2)) if W2 != 0 else h7
        return [h7, h8]

    def expected_errors(self, s):
        learned = self.learned
        records = [self.record[u] for u in s.experienced]
        part = 65536 // (4 + 4 * len(records))
        l = log8(s.length)

        def usual(r, errors):
            return (4 * max(0, l + trunc_div(r, 16)) + 4 * errors) * part

        s.scale = [[], []] + [[min(usual(learned.ratio[i][k], sum(r.error[i][k] for r in records)) >> 17, 95)
                               for k in range(3)] for i in range(2, self.P)]
        s.across = usual(learned.normal_ratio[0], sum(r.normal_error[0] for r in records)) >> 16
        s.tangent = usual(learned.normal_ratio[1], sum(r.normal_error[1] for r in records)) >> 16
        if s.n == ZERO:
            s.across = s.tangent

    # 13.12 One coordinate after the other

    def read_coordinates(self, v, s):
        s.x, s.err, cell = [], [], []
        for k in range(3):
            self.predict_on_surface(s, k, 0, s.across - s.tangent)
            self.predict_on_surface(s, k, 1, s.across - s.tangent - 14)
            opinions = []
            for i in range(self.P):
                scale = s.scale[i][k]
                band = 0 if scale < 16 else 1 if scale < 32 else 2
                opinions.append((s.origin[k] + s.predictor[i][k], scale, self.learned.shapes[i][band]))
            misses = [sum(abs(s.x[j] - s.predictor[i][j]) for j in range(k)) for i in range(2, self.P)]
            least = min(misses)
            best = 2 + misses.index(least)                  # i*
            sure = 0 if k == 0 else 1 if least <= 8 * k else 2 if least <= 24 * k else 3
            if self.has_repeats and self.shift == 0:
                opinions += self.repeats(s, k, cell, best, sure)
            reader = ValueReader(self.decoder, self.learned.mixing, opinions, self.contexts(s, k, sure),
                                 self.values[k] if self.values is not None and self.shift == 0 else None)
            if self.is_birth:
                limit = 1 << (self.bits - self.shift)
                guide = clamp((s.origin[k] + s.best[k] + 8) >> 4, 0, limit - 1)
                X = reader.around(0, limit, guide, max(0, trunc_div(s.scale[0][k] - 20, 4)))
            else:
                X = reader.within(self.cell[v][k] << self.b, self.b)
            cell.append(X)
            s.x.append(16 * X - s.origin[k])
            s.err.append(s.down(s.x[k] - s.best[k]))
        return tuple(cell)

    def predict_on_surface(self, s, k, i, rho):
        """predictors 0 and 1"""
        n = s.n
        g = exp8(clamp(2 * rho, -80, 48)) - 4096
        q = sum((n[j] * n[j]) >> 14 for j in range(k))
        e = sum((n[j] * s.err[j]) >> 14 for j in range(k))
        D = max(4096 + ((g * q) >> 14), 4)
        D2 = max(4096 + ((g * (q + ((n[k] * n[k]) >> 14))) >> 14), 4)
        s.predictor[i].append(s.best[k] + s.up(clamp(trunc_div(((g * n[k]) >> 14) * e, D), -122880, 122880)))
        s.scale[i].append(clamp((s.tangent + ((log8(D2) - log8(D)) >> 1)) >> 1, 0, 95))

    def repeats(self, s, k, cell, best, sure):
        """the opinions of the repeats"""
        def near(x):
            return (s.origin[k] + x + 8) & ~15

        def cell_of(u):
            return near(0) if u is None else 16 * self.cell[u][k]

        match, D = None, 0
        for u in s.known:
            total = sum(abs(self.cell[u][j] - cell[j]) for j in range(k))
            if match is None or total < D:
                match, D = u, total
        if k == 0 or match is None:
            match_context = 0
        else:
            match_context = 1 if D == 0 else 2 if D <= 2 else 3
        others = [u for u in s.known if u not in (s.a, s.b)] if self.is_birth else s.known
        last = others[-1] if others else None
        if self.is_birth:
            sixth = s.a
        else:
            sixth = s.known[0] if s.known else None
        told = ((near(s.center[k]), 0),
                (near(s.predictor[5][k]), min(s.g, 3)),
                (near(s.predictor[7][k]), 1 if s.g > 0 else 0),
                (cell_of(match), match_context),
                (cell_of(last), 0 if last is None else 1),
                (near(s.predictor[best][k]), sure),
                (cell_of(sixth), 0))
        return [(centre, 8, self.learned.repeats[i][k][context]) for i, (centre, context) in enumerate(told)]

    def contexts(self, s, k, sure):
        if not self.has_repeats or (not self.is_birth and self.b == 1):
            A = clamp(trunc_div(s.scale[0][k] - 12, 4), 0, 7)
        else:
            repeated = sum(self.record[u].repeated for u in s.known)
            if not s.known:
                A = 0
            elif repeated == 0:
                A = 1
            elif repeated == len(s.known):
                A = 4
            else:
                A = 2 if 2 * repeated < len(s.known) else 3
        B = 4 * k + (min(s.g, 3) if k == 0 else sure)
        steep = abs(s.n[k])
        C = 4 * k + (0 if s.n == ZERO else 1 if steep < 4915 else 2 if steep < 13107 else 3)
        return A, B, C

    # 13.13 Learning from a vertex

    def learn(self, v, s, cell):
        learned, x, n = self.learned, s.x, s.n
        l = log8(s.length)
        L = bitlen(s.length)

        def errorlog(e):
            return min(log8(abs(e) + 8), 255)

        def follow(ratios, i, e):
            ratios[i] += trunc_div((e - l) * 16 - ratios[i], 32)

        def importance(e):
            return (1 << 20) // (1024 + ((min(abs(e), 4096) ** 2) >> 4) + (22369621 >> min(2 * L, 31))) + 1

        record = self.record[v] = Record()
        record.offset = sub(x, s.center)
        for i in range(2, self.P):
            for k in range(3):
                record.error[i][k] = errorlog(x[k] - s.predictor[i][k])
                follow(learned.ratio[i], k, record.error[i][k])
        for guess in s.center, s.predictor[3], s.predictor[5], s.predictor[7]:
            if all(abs(x[k] - guess[k]) <= 8 for k in range(3)):
                record.repeated = 1
        z = sub(x, s.best)
        t = along(z, n)
        T = max(z[0] * z[0] + z[1] * z[1] + z[2] * z[2] - t * t, 0) // 2
        record.normal_error = [errorlog(t), min(log8(T + 64) // 2, 255)]
        if n != ZERO:
            for i in 0, 1:
                follow(learned.normal_ratio, i, record.normal_error[i])
        y = [s.feature(x[k]) for k in range(3)]
        for k in range(3):
            learned.offset[s.class_].observe(s.f[k], y[k], importance(y[k] - s.plain[k]))
        learned.offset[s.class_].end()
        if n != ZERO:
            Y = clamp(along(y, n), -8192, 8192)
            learned.height[s.class_].observe(s.h, Y, importance(Y - s.height))
            learned.height[s.class_].end()
        if self.shift == 0 and self.values is not None:
            for k in range(3):
                insort(self.values[k], cell[k])


class Sight:
    """What a vertex sees (13.11), with the scaled numbers of its length."""

    def set_scale(self, length):
        self.L = bitlen(length)

    def down(self, x):
        return x << (12 - self.L) if self.L <= 12 else x >> (self.L - 12)

    def up(self, x):
        return x >> (12 - self.L) if self.L <= 12 else x << (self.L - 12)

    def feature(self, x):
        return clamp(self.down(x), -8192, 8192)


# ----------------------------------------------------------------------------------------------------------------
# 12.3 Restoration
# ----------------------------------------------------------------------------------------------------------------

class Restoration:
    def __init__(self, head, mesh, positions, glue):
        self.head, self.mesh = head, mesh
        self.turned = [0] * mesh.faces
        self.number = [NONE] * mesh.vertices                # in the restored mesh
        self.positions = []
        for v in range(mesh.vertices):
            first = glue.first_of(v)
            if first == v:
                self.number[v] = len(self.positions)
                self.positions.append(positions[v])
            else:
                self.number[v] = self.number[first]

    def face(self, f, turn):
        a, b, c = (self.number[v] for v in self.mesh.V[3 * f:3 * f + 3])
        return (a, c, b) if turn else (a, b, c)

    def glued(self):
        """What there is before anything is read: level J without copies."""
        return self.positions, [self.face(f, False) for f in range(self.mesh.faces)]

    def read(self, decoder):
        """The restored mesh: lattice positions and faces."""
        self.decoder = decoder
        mesh, head = self.mesh, self.head
        positions = list(self.positions)
        isolated = head.original_vertices - len(positions)
        if isolated < 0:
            raise corrupt("the original has fewer vertices than level J")

        flag, turned_bits, has_bits = bits_of(2), bits_of(16), bits_of(16)
        copies, turns = AdaptiveUnsigned(32), AdaptiveUnsigned(32)
        step, other = AdaptiveSigned(32), AdaptiveSigned(32)
        left = head.original_faces - mesh.faces
        turned = self.turned
        if bit(decoder, flag[0], 255) == 1:
            for f in range(mesh.faces):
                turned[f] = bit(decoder, turned_bits[self.around(f, turned)], 255)
        has = [0] * mesh.faces
        same_turned = []                                    # (face, same, turned)
        if bit(decoder, flag[1], 255) == 1:
            for f in range(mesh.faces):
                has[f] = bit(decoder, has_bits[self.around(f, has)], 255)
                if has[f]:
                    n = 1 + copies.read(decoder)
                    t = turns.read(decoder)
                    if n > left or t > n:
                        raise corrupt("copies of a face")
                    same_turned.append((f, n - t, t))
                    left -= n
        if isolated > 0:
            self.single = bits_of(3)
            self.together = [bits_of(17) for _ in range(3)]
            self.below = [bits_of(17) for _ in range(3)]
            self.half = [[AdaptiveSigned(32) for _ in range(17)] for _ in range(3)]
            self.box([0, 0, 0], [head.bits] * 3, isolated, positions)

        faces = [self.face(f, turned[f]) for f in range(mesh.faces)]
        for f, same, others in same_turned:
            faces += [self.face(f, turned[f])] * same + [self.face(f, not turned[f])] * others
        last = 0
        for _ in range(left):
            a = last + step.read(decoder)
            b = a + other.read(decoder)
            if not (0 <= a < len(positions) and 0 <= b < len(positions)):
                raise corrupt("a degenerate face has a vertex that does not exist")
            faces.append((a, a, b))
            last = a
        return positions, faces

    def around(self, f, property_):
        index = 0
        for c in range(3 * f, 3 * f + 3):
            o = self.mesh.opp[c]
            if o != NONE and o // 3 < f:
                index += 4 if property_[o // 3] else 1
        return index

    def box(self, low, sides, count, points):
        decoder = self.decoder
        axis = sides.index(max(sides))
        if sides[axis] == 0:
            points += [tuple(low)] * count
            return
        sides = list(sides)
        sides[axis] -= 1
        upper = list(low)
        upper[axis] += 1 << sides[axis]
        row = min(bitlen(count), 16)
        if count == 1:
            lower = bit(decoder, self.single[axis], 255)
        elif bit(decoder, self.together[axis][row], 60) == 1:
            lower = count if bit(decoder, self.below[axis][row], 60) == 1 else 0
        else:
            lower = clamp(count // 2 + self.half[axis][row].read(decoder), 1, count - 1)
        if lower > 0:
            self.box(low, sides, lower, points)
        if count - lower > 0:
            self.box(upper, sides, count - lower, points)


# ----------------------------------------------------------------------------------------------------------------
# 12.4 Exact coordinates
# ----------------------------------------------------------------------------------------------------------------

MAX_F32 = struct.unpack("<f", b"\xff\xff\x7f\x7f")[0]


def f32(x):
    return struct.unpack("<f", struct.pack("<f", clamp(x, -MAX_F32, MAX_F32) if isfinite(x) else x))[0]


def ordinal(x, wide):
    i = struct.unpack("<q", struct.pack("<d", x))[0] if wide else struct.unpack("<i", struct.pack("<f", f32(x)))[0]
    return i if i >= 0 else i ^ ((1 << 63) - 1 if wide else (1 << 31) - 1)


def number_of(i, wide):
    """the number with an ordinal"""
    if wide:
        i = wrap64(i)
        return struct.unpack("<d", struct.pack("<q", i if i >= 0 else i ^ ((1 << 63) - 1)))[0]
    i = wrap32(i)
    return struct.unpack("<f", struct.pack("<i", i if i >= 0 else i ^ ((1 << 31) - 1)))[0]


class ExactRows:
    """Differences of one kind and axis: rows by reach, and their common first digits."""

    def __init__(self):
        self.rows = {}
        self.top = [bits_of(4) for _ in range(5)]

    def read(self, decoder, reach):
        if reach not in self.rows:
            self.rows[reach] = (AdaptiveBit(), AdaptiveBit(), bits_of(64))
        zero, sign, length = self.rows[reach]
        if bit(decoder, zero, 255) == 1:
            return 0
        negative = bit(decoder, sign, 255)
        n = 0
        while n < 64 and bit(decoder, length[n], 255) == 1:
            n += 1
        m = min(n, 1)
        t = clamp(reach - n + 2, 0, 4)
        for digit in range(n - 1):
            if digit == 0:
                m = 2 * m + bit(decoder, self.top[t][0], 255)
            elif digit == 1:
                m = 2 * m + bit(decoder, self.top[t][m], 255)
            else:
                m = 2 * m + decoder.raw(1)
        return -m - 1 if negative else m + 1


class ExactNumbers:
    def __init__(self, wide, digits, axes):
        self.wide, self.digits = wide, digits
        self.decimal = bits_of(axes)
        self.zeros = [[bits_of(4) for _ in range(55)] for _ in range(axes)]
        self.binary_rows = [ExactRows() for _ in range(axes)]
        self.decimal_rows = [ExactRows() for _ in range(axes)]

    def read(self, decoder, k, p, step):
        if self.digits >= 0 and bit(decoder, self.decimal[k], 255) == 1:
            power = float(10 ** self.digits)

            def n(x, u):
                return floor(clamp(x * power / u + 0.5, -2.0 ** 53, 2.0 ** 53)) if isfinite(x) else 0

            unit = 1
            zeros = self.zeros[k][bitlen(abs(n(p, 1)))]
            for i in range(4 if self.digits > 0 else 0):
                if bit(decoder, zeros[i], 255) == 0:
                    break
                unit *= 10
            count = unit * (n(p, unit) + self.decimal_rows[k].read(decoder, bitlen(n(step, unit))))
            x = float(count) / power
            return x if self.wide else f32(x)
        o = ordinal(p, self.wide)
        reach = ordinal(p + step, self.wide) - o
        return number_of(o + self.binary_rows[k].read(decoder, bitlen(reach)), self.wide)


def read_exact(decoder, head, positions):
    """The exact coordinates of the restored mesh with these lattice positions."""
    wide = decoder.raw(1)
    numbers = ExactNumbers(wide, decoder.raw(4) - 1, 3)
    result = []
    for P in positions:
        p = model_position(head, P)
        result.append(tuple([numbers.read(decoder, k, p[k], head.step) for k in range(3)]))
    return result


# ----------------------------------------------------------------------------------------------------------------
# 12.5 Order
# ----------------------------------------------------------------------------------------------------------------

AGES = 12                                   # faces told that have slots
NO_SLOT = 9 * AGES                          # 108
ORDER_LIMIT = 30                            # of all AdaptiveBits here
SLOT, FRONT, ANYWHERE = 0, 1, 2             # kinds


def table_of(*sizes):
    """AdaptiveBits in so many dimensions, made when first asked for: table[i, j, ...]. Sizes are for the reader."""
    return BitTable()


class BitTable(dict):
    def __missing__(self, index):
        self[index] = AdaptiveBit()
        return self[index]


def place(t):
    return 9 if t == NO_SLOT else t % 9


class Free:
    """Numbers below a count that are not taken, ascending: `free`, and the faces not told."""

    def __init__(self, count):
        self.numbers = list(range(count))

    def has(self, n):
        i = bisect_left(self.numbers, n)
        return i < len(self.numbers) and self.numbers[i] == n

    def rank(self, n):
        return bisect_left(self.numbers, n)

    def near(self, rank):
        """the one with so many below it, or the first or last"""
        return self.numbers[clamp(rank, 0, len(self.numbers) - 1)]

    def take(self, n):
        del self.numbers[bisect_left(self.numbers, n)]


class Order:
    """Of the restored mesh: its number of vertices, its faces; and the mesh of level J, whose faces are the first."""

    def __init__(self, mesh, vertices, faces):
        self.mesh = mesh
        self.vertices = vertices
        self.faces = faces
        self.kind = table_of(2, 9, 109)
        self.after, self.after2 = table_of(108, 109), table_of(108, 109, 10)
        self.amongs = table_of(108, 512)
        self.slots = Mixer(3, 108)
        self.rank = [AdaptiveUnsigned(32) for _ in range(33)]
        self.jump = [AdaptiveSigned(32) for _ in range(33)]
        self.lastjump = 0
        self.use, self.edge = table_of(2, 8), table_of(2, 109, 8)
        self.edge2, self.numbers = table_of(2, 109, 10, 8), table_of(2, 64)
        self.first = Mixer(4, 2)
        self.gafter, self.gafter2 = table_of(15, 16), table_of(15, 16, 16)
        self.at, self.with_ = table_of(15, 16), table_of(15, 109, 16)
        self.guess = Mixer(4, 15)
        self.places = table_of(7, 8)
        self.steps = [[AdaptiveSigned(32) for _ in range(8)] for _ in range(8)]
        self.t1 = self.t2 = NO_SLOT
        self.k1 = self.k2 = ANYWHERE

    def read(self, decoder):
        """For each face of the original: the restored face, and which of its corners is the first; and for each
        restored vertex its number."""
        self.decoder = decoder
        self.order = []
        self.untold = Free(len(self.faces))
        self.is_told = [False] * len(self.faces)
        self.front = []                                     # in the order in which they joined
        self.joined = set()
        self.free = Free(self.vertices)
        self.number = [None] * self.vertices
        self.recent = [(n & 0xFFFFFFFF) for n in (-1, -2, -3, -4, -5)]                      # l0..l4
        self.da, self.db, self.da_before = [0] * 3, [0] * 3, [0] * 3
        self.g1 = self.g2 = 15
        self.lastplace = self.laststep = 0
        for _ in range(len(self.faces)):
            f, t, k = self.read_face()
            self.t1, self.t2 = t, self.t1
            self.k1, self.k2 = k, self.k1
            start = self.read_first_corner(f)
            self.tell(f, start)
            corners = [(start + k) % 3 for k in range(3)]
            for q in range(3):
                if self.number[self.faces[f][corners[q]]] is None:
                    self.read_number(q, *self.around(f, corners, q))
        for v in range(self.vertices):
            if self.number[v] is None:
                self.read_number(3, v, None, None, None)
        return self.order, self.number

    def bit(self, model):
        return bit(self.decoder, model, ORDER_LIMIT)

    # Faces

    def neighbour(self, corner):
        """The face across a corner of level J; none beyond it"""
        d = self.mesh.opp[corner] if corner < len(self.mesh.opp) else NONE
        return d // 3 if d != NONE else NONE

    def fill_slots(self):
        """slot -> face, and `among` of the ages"""
        filled, among = {}, [0] * AGES
        mesh = self.mesh
        taken = set()

        def fill(age, s, corner):
            f = self.neighbour(corner)
            if f != NONE and not self.is_told[f] and f not in taken:
                taken.add(f)
                filled[9 * age + s] = f
                among[age] |= 1 << s

        for age in range(min(AGES, len(self.order))):
            f, start = self.order[-1 - age]
            if f >= mesh.faces:
                continue
            for k in range(3):
                c = 3 * f + (start + k) % 3
                fill(age, k, c)
                d = mesh.opp[c]
                if d != NONE:
                    fill(age, 3 + 2 * k, mesh.next[d])
                    fill(age, 4 + 2 * k, mesh.prev[d])
        return filled, among

    def read_face(self):
        """The next face, its slot and its kind"""
        filled, among = self.fill_slots()
        kinds = 3 * self.k1 + self.k2
        if filled and self.bit(self.kind[SLOT, kinds, self.t1]) == 1:
            slots = sorted(filled)
            for s in slots:
                models = (self.after[s, self.t1], self.after2[s, self.t1, place(self.t2)],
                          self.amongs[s, among[s // 9]])
                if s == slots[-1] or self.slots.mix(self.decoder, models, s, ORDER_LIMIT) == 1:
                    return filled[s], s, SLOT
        if self.front and self.bit(self.kind[FRONT, kinds, self.t1]) == 1:
            n = len(self.front)
            r = min(self.rank[bitlen(n)].read(self.decoder), n - 1)
            return self.front[n - 1 - r], NO_SLOT, FRONT
        start = self.untold.rank(self.order[-1][0]) if self.order else 0
        d = self.jump[self.lastjump].read(self.decoder)
        self.lastjump = bitlen(abs(d))
        return self.untold.near(start + d), NO_SLOT, ANYWHERE

    def tell(self, f, start):
        self.order.append((f, start))
        self.is_told[f] = True
        self.untold.take(f)
        if f in self.joined:
            self.front.remove(f)
        self.joined.add(f)
        for c in range(3 * f, 3 * f + 3):
            g = self.neighbour(c)
            if g != NONE and g not in self.joined:
                self.joined.add(g)
                self.front.append(g)

    # First corner

    def read_first_corner(self, f):
        face, t1 = self.faces[f], self.t1
        age = 0 if t1 == NO_SLOT else t1 // 9
        other = self.faces[self.order[-1 - age][0]] if self.order else ()
        used = [self.number[v] is not None for v in face]
        number = [self.number[v] if self.number[v] is not None else 1 << 32 for v in face]
        shared = [v in other for v in face]
        for turn in 0, 1:
            a, b, c = turn, turn + 1, (turn + 2) % 3
            U = used[a] + 2 * used[b] + 4 * used[c]
            S = shared[a] + 2 * shared[b] + 4 * shared[c]
            O = (number[a] < number[b]) + 2 * (number[b] < number[c]) + 4 * (number[c] < number[a])
            models = (self.use[turn, U], self.edge[turn, t1, S], self.edge2[turn, t1, place(self.t2), S],
                      self.numbers[turn, O + 8 * U])
            if self.first.mix(self.decoder, models, turn, ORDER_LIMIT) == 1:
                return turn
        return 2

    # Numbers

    def around(self, f, corners, q):
        """The vertex at corner q and the numbers a, b, x"""
        face = self.faces[f]
        before, after = face[corners[(q + 2) % 3]], face[corners[(q + 1) % 3]]
        x = None
        g = self.neighbour(3 * f + corners[q])
        if g != NONE:
            for v in self.faces[g]:
                if v != before and v != after:
                    x = self.number[v]
                    break
        return face[corners[q]], self.number[before], self.number[after], x

    def guesses(self, q, a, b, x):
        """Of all 15, None if a number in it is none"""
        l0, l1, _, l3, _ = self.recent
        guess = [self.free.numbers[0], l0 + 1, l0 - 1, l0 + 2, l0 - 2] + [None] * 10
        if a is not None:
            guess[6] = a + self.da[q]
            guess[9], guess[10] = a + 1, a - 1
            guess[13] = (a + self.da[q]) + (self.da[q] - self.da_before[q])
        if b is not None:
            guess[7] = b + self.db[q]
            guess[11], guess[12] = b + 1, b - 1
        if a is not None and b is not None and x is not None:
            guess[5] = a + b - x
        guess[8] = l0 + (l0 - l1)
        guess[14] = l1 + (l1 - l3)
        return [g & 0xFFFFFFFF if g is not None else None for g in guess]

    def read_number(self, q, v, a, b, x):
        guess = self.guesses(q, a, b, x)
        n = self.read_guess(q, a, b, guess)
        if n is None:
            n = self.read_near(guess, a, b)
        if a is not None:
            self.da_before[q], self.da[q] = self.da[q], n - a
        if b is not None:
            self.db[q] = n - b
        self.recent = [n] + self.recent[:4]
        self.free.take(n)
        self.number[v] = n

    def read_guess(self, q, a, b, guess):
        C = q + 4 * (a is not None) + 8 * (b is not None)
        found = None
        for s in range(15):
            if guess[s] is None or not self.free.has(guess[s]) or guess[s] in guess[:s]:
                continue
            models = (self.gafter[s, self.g1], self.gafter2[s, self.g1, self.g2], self.at[s, C],
                      self.with_[s, self.t1, C])
            if self.guess.mix(self.decoder, models, s, ORDER_LIMIT) == 1:
                found = s
                break
        self.g1, self.g2 = 15 if found is None else found, self.g1
        return None if found is None else guess[found]

    def read_near(self, guess, a, b):
        places = (guess[6], guess[7], guess[5], a, b) + tuple(self.recent[:3])
        p = 0
        while p < 7:
            if places[p] is not None and places[p] != 0xFFFFFFFF and self.bit(self.places[p, self.lastplace]) == 1:
                break
            p += 1
        d = self.steps[p][min(self.laststep, 7)].read(self.decoder)
        self.lastplace, self.laststep = p, bitlen(abs(d))
        return self.free.near(self.free.rank(min(places[p], self.vertices)) + d)


# ----------------------------------------------------------------------------------------------------------------
# 12.6 Attributes: what the head says
# ----------------------------------------------------------------------------------------------------------------

VERTICES, FACES, CORNERS, MESH = range(4)   # of what
KINDS = ("custom", "colour", "normal", "quality", "texture coordinate", "radius", "selected", "edges inside polygons",
         "transformation")
COLOUR, NORMAL, POLYGON_EDGES = 1, 2, 7
INTEGER, F32, F64 = range(3)                # types


class Column:
    """On lattices: bits, whole, low, step."""


class Attribute:
    """of, kind, type, columns (their number), name; and how it is coded: lattices (a Column each) or None; exact:
    (wide, digits) or None; octahedron: its bits or 0. size: bytes of the file, for information."""

    def is_faux_edges(self):
        if self.kind != POLYGON_EDGES or self.of != FACES or self.columns != 1 or not self.lattices:
            return False
        column = self.lattices[0]
        return column.whole and column.low == 0 and column.bits == 3

    def is_normals(self):
        return self.kind == NORMAL and self.of != MESH and self.columns == 3

    def on_levels(self):
        return not self.is_faux_edges() and not self.is_normals()

    def value(self, row):
        """What a row of numbers stands for"""
        if self.octahedron:
            x, y, z = row
            length = sqrt(x * x + y * y + z * z)
            result = [float(x) / length, float(y) / length, float(z) / length]
        elif self.lattices:
            result = [float(c.low) + c.step * n for c, n in zip(self.lattices, row)]
        else:
            return tuple(row)
        if self.type == F32:
            result = [f32(x) for x in result]
        if self.type == INTEGER and all(c.whole for c in self.lattices or ()) and not self.octahedron:
            result = [int(x) for x in result]
        return tuple(result)


class HeadReader:
    """Fields of a payload one after the other; corrupt if they are not all there."""

    def __init__(self, payload, offset):
        self.payload, self.offset = payload, offset

    def bytes(self, n):
        if self.offset + n > len(self.payload):
            raise corrupt("the head's fields are not all there")
        self.offset += n
        return bytes(self.payload[self.offset - n:self.offset])

    def u8(self):
        return self.bytes(1)[0]

    def f64(self):
        return struct.unpack("<d", self.bytes(8))[0]

    def varint(self, limit=(1 << 63) - 1):
        got = read_varint(self.payload, self.offset)
        if got is None:
            raise corrupt("the head's fields are not all there")
        if got[0] > limit:
            raise corrupt("a number in the head is out of range")
        self.offset = got[1]
        return got[0]


def read_attributes(payload, offset):
    """The attributes, the names of the textures, and the offset behind them"""
    head = HeadReader(payload, offset)
    count = head.varint(64)
    textures = head.varint(65535)
    attributes = [read_attribute(head) for _ in range(count)]
    return attributes, [head.bytes(head.varint(65535)) for _ in range(textures)], head.offset


def read_attribute(head):
    a = Attribute()
    a.of, a.kind, a.type, a.columns, coding = (head.u8() for _ in range(5))
    if a.of > MESH or a.type > F64 or not 1 <= a.columns <= 16:
        raise corrupt("a field of an attribute is out of range")
    a.lattices = a.exact = None
    a.octahedron = 0
    if coding == 0:
        a.lattices = [read_column(head) for _ in range(a.columns)]
    elif coding <= 32:
        a.exact = ((coding - 1) & 1, ((coding - 1) >> 1) - 1)
    elif 66 <= coding <= 84 and a.is_normals():
        a.octahedron = coding - 64
    else:
        raise corrupt("coding of an attribute")
    a.size = head.varint()
    a.name = head.bytes(head.varint(255))
    return a


def read_column(head):
    column = Column()
    byte = head.u8()
    column.bits, column.whole = byte & 127, byte >= 128
    if column.bits > 24:
        raise corrupt("bits of a column are out of range")
    if column.whole:
        n = head.varint((1 << 55) - 1)
        column.low, column.step = (n >> 1 if n & 1 == 0 else -((n + 1) >> 1)), 1
    else:
        column.low, column.step = head.f64(), head.f64()
        if not (column.step > 0 and isfinite(column.low) and isfinite(column.low + column.step * (1 << 24))):
            raise corrupt("a column's lattice is not finite")
    return column


# ----------------------------------------------------------------------------------------------------------------
# 12.6 A row
# ----------------------------------------------------------------------------------------------------------------

# A row is a tuple of numbers, None if it is missing. read(decoder, a, b, l, r) reads one next to these.

def same(a, b):
    """Are rows equal? Bit for bit, as zeros of two signs and what is no number are not told by ==."""
    if a is None or b is None:
        return a is b
    return a is b or struct.pack("<%dd" % len(a), *a) == struct.pack("<%dd" % len(b), *b)


class ExactCoder:
    def __init__(self, attribute):
        wide, digits = attribute.exact
        self.columns = attribute.columns
        self.is_colour = attribute.kind == COLOUR
        self.numbers = ExactNumbers(wide, digits, self.columns)

    def read(self, decoder, a, b, l, r):
        row = []
        onward = off = 0.0
        for k in range(self.columns):
            x = float(a[k]) if a and isfinite(a[k]) else 0.0
            y = (float(b[k]) if isfinite(b[k]) else 0.0) if b else x
            p = 0.5 * x + 0.5 * y + onward
            spread = max(abs(0.5 * x - 0.5 * y), 0.5 * off)
            v = self.numbers.read(decoder, k, p, spread)
            row.append(v)
            off = abs(v - p)
            if not isfinite(off):
                off = 0.0
            onward = v - p if self.is_colour and k < 2 and isfinite(v - p) else 0.0
        return tuple(row)


class LatticeColumn:
    """What is learned of a column."""

    def __init__(self, bits):
        self.bits = bits
        self.ratio = [0] * 8
        self.error = [0] * 8
        self.last = self.lastoff = 0
        self.shape = [[Shape() for _ in range(3)] for _ in range(8)]


class LatticeCoder:
    def __init__(self, bits):
        self.columns = [LatticeColumn(n) for n in bits]
        self.mixing = Mixing(6144)

    def read(self, decoder, a, b, l, r):
        row = []
        off = 0
        for k, column in enumerate(self.columns):
            if column.bits == 0:
                row.append(0)
                continue
            A = a[k] if a else 1 << (column.bits - 1)
            B = b[k] if b else A
            wings = (l[k], r[k]) if l and r else None
            X, off = self.read_number(decoder, column, k, A, B, b is not None, wings, off)
            row.append(X)
        return tuple(row)

    def read_number(self, decoder, column, k, A, B, has_b, wings, off):
        """The number and its `off`"""
        def log(x):
            return min(log8(abs(x) + 8), 255)

        mean = 8 * (A + B)
        bend = across = 0
        if wings:
            bend = 2 * (wings[0] + wings[1] - A - B)
            across = wings[0] - wings[1]
        spread = log(8 * (abs(A - B) + abs(across)) + 8)
        seen = log(off) if k > 0 else column.error[0]
        centres = (mean, mean + bend, 16 * A, 16 * B, mean + column.lastoff,
                   mean + (off if k > 0 else trunc_div(column.lastoff, 2)), column.last, mean - bend)
        scales, opinions = [], []
        for i in range(8):
            expected = max(0, spread + trunc_div(column.ratio[i], 16))
            scale = min(trunc_div(3 * expected + column.error[i], 8), 95)
            scales.append(scale)
            opinions.append((centres[i], scale, column.shape[i][min(scale // 16, 2)]))
        best = column.ratio.index(min(column.ratio))
        contexts = (4 * min(k, 2) + clamp(trunc_div(seen - 24, 16), 0, 3),
                    has_b + (4 if wings else 0) + (5 if A == B else 0),
                    min(scales[0] // 6, 11))
        limit = 1 << column.bits
        guide = clamp((centres[best] + 8) >> 4, 0, limit - 1)
        reader = ValueReader(decoder, self.mixing, opinions, contexts, None)
        X = reader.around(0, limit, guide, max(0, trunc_div(scales[best] - 20, 4)))
        for i in range(8):
            e = log(16 * X - centres[i])
            column.ratio[i] += trunc_div((e - spread) * 16 - column.ratio[i], 32)
            column.error[i] = e
        column.lastoff = 16 * X - mean
        column.last = 16 * X
        return X, column.lastoff


def axes_of(a):
    """w, u, v: the axis of the largest component, of equals the first, and the two after it, cyclically"""
    w = max(range(3), key=lambda k: abs(a[k]))
    return w, (w + 1) % 3, (w + 2) % 3


def on_octahedron(x, rho):
    """The row next to a direction"""
    S = abs(x[0]) + abs(x[1]) + abs(x[2])
    if S == 0:
        return (0, 0, rho)
    w, u, v = axes_of(x)
    row = [0, 0, 0]
    for k in u, v:
        t = floor(abs(x[k]) / S * rho + 0.5)
        row[k] = -t if x[k] < 0 else t
    height = rho - abs(row[u]) - abs(row[v])
    row[w] = -height if x[w] < 0 else height
    return tuple(row)


def expected_normals(of, positions, faces):
    """Of the restored mesh, on its lattice: of each vertex, face or corner a direction"""
    def cross_of(p, q, r):
        a, b = [float(x) for x in sub(q, p)], [float(x) for x in sub(r, p)]
        return tuple(a[i] * b[j] - a[j] * b[i] for i, j in ((1, 2), (2, 0), (0, 1)))

    normals_of_faces = [cross_of(*(positions[v] for v in face)) for face in faces]
    total = [(0.0, 0.0, 0.0)] * len(positions)
    for face, n in zip(faces, normals_of_faces):
        for v in face:
            total[v] = add(total[v], n)
    result = normals_of_faces if of == FACES else total
    for i, (x, y, z) in enumerate(result):
        length = sqrt(x * x + y * y + z * z)
        result[i] = (x / length, y / length, z / length) if length > 0 else (0.0, 0.0, 0.0)
    return result if of != CORNERS else [result[v] for face in faces for v in face]


def expected_row(attribute, direction):
    if attribute.octahedron:
        return on_octahedron(direction, 1 << (attribute.octahedron - 1))
    if attribute.lattices:
        return tuple(clamp(floor((x - c.low) / c.step + 0.5), 0, (1 << c.bits) - 1)
                     for x, c in zip(direction, attribute.lattices))
    return direction


class OctahedronCoder:
    def __init__(self, bits):
        self.radius = 1 << (bits - 1)
        self.lattice = LatticeCoder([bits + 1, bits + 1])
        self.turned = AdaptiveBit()

    def read(self, decoder, a, b, l, r):
        rho = self.radius
        w, u, v = axes_of(a)
        x, y = self.lattice.read(decoder, (a[u] + rho, a[v] + rho), None, None, None)
        row = [0, 0, 0]
        row[u], row[v] = x - rho, y - rho
        height = max(0, rho - abs(row[u]) - abs(row[v]))
        if height > 0:
            negative = a[w] < 0
            if bit(decoder, self.turned, 255) == 1:
                negative = not negative
            row[w] = -height if negative else height
        return tuple(row)


# ----------------------------------------------------------------------------------------------------------------
# 12.6 Rows of a level
# ----------------------------------------------------------------------------------------------------------------

class Descent:
    """Where the faces and corners of a level come from: face[f], the face of the parent level; first[F], the lowest
    face that came from F (one more than there are F); sources[c], one or two corners of the parent level, or none."""

    def __init__(self, parent, mesh, split):
        self.split = split
        self.first = [0]
        self.face = []
        for F in range(parent.faces):
            number = 3 if split.centre[F] != NONE else 1 + split.splits[F]
            self.face += [F] * number
            self.first.append(len(self.face))
        self.sources = [self.find_sources(parent, mesh, c) for c in range(len(mesh.V))]
        for v in range(mesh.vertices):
            fan = mesh.corners[v]
            for c, before in zip(fan[1:], fan):
                self.sources[c] = self.sources[c] or self.sources[before]
            for c, behind in zip(fan[-2::-1], fan[::-1]):
                self.sources[c] = self.sources[c] or self.sources[behind]

    def find_sources(self, parent, mesh, c):
        v = mesh.V[c]
        F = self.face[c // 3]
        wanted = (v,) if v < parent.vertices else self.split.parents[v - parent.vertices][:2]
        at = {parent.V[e]: e for e in range(3 * F, 3 * F + 3)}
        return tuple(at[u] for u in wanted) if all(u in at for u in wanted) else ()


class Channel:
    """An attribute: its rows of the level that is there, and what is learned of it."""

    def __init__(self, attribute):
        self.attribute = attribute
        self.rows = None
        if attribute.octahedron:
            self.coder = OctahedronCoder(attribute.octahedron)
        elif attribute.lattices:
            self.coder = LatticeCoder([c.bits for c in attribute.lattices])
        else:
            self.coder = ExactCoder(attribute)
        self.kept, self.same, self.single, self.other = (bits_of(4) for _ in range(4))
        self.last = 0
        self.zero = (0,) * attribute.columns

    def read_base(self, decoder, mesh, glue):
        """The rows of level 0"""
        self.decoder = decoder
        self.mesh = mesh
        self.rows = []
        of = self.attribute.of
        if of == MESH:
            self.rows.append(self.row(None))
        elif of == VERTICES:
            for v in range(mesh.vertices):
                if glue and glue.first[v] != v:
                    self.rows.append(self.rows[glue.first[v]])
                else:
                    self.rows.append(self.row_after(self.rows))
        elif of == FACES:
            for f in range(mesh.faces):
                self.rows.append(self.row(*self.beside(f)))
        else:
            self.rows = [None] * len(mesh.V)
            for v in range(mesh.vertices):
                self.read_new_vertex(v, {c: self.known_in_face(c) + (None, None) for c in mesh.corners[v]})

    def row(self, a, b=None, l=None, r=None):
        return self.coder.read(self.decoder, a, b, l, r)

    def row_after(self, rows):
        """next to the row before and that before it"""
        return self.row(rows[-1] if rows else None, rows[-2] if len(rows) > 1 else None)

    def bit(self, model):
        return bit(self.decoder, model, 255)

    def beside(self, f):
        """a, b of a face of level 0"""
        lower = [self.mesh.opp[c] // 3 for c in range(3 * f, 3 * f + 3)
                 if self.mesh.opp[c] != NONE and self.mesh.opp[c] // 3 < f]
        if not lower:
            return (self.rows[f - 1] if f > 0 else None), None
        return self.rows[lower[0]], (self.rows[lower[-1]] if len(lower) > 1 else None)

    def known_in_face(self, c):
        """a, b of a corner of level 0"""
        mesh = self.mesh
        v = mesh.V[c]
        known = [self.rows[e] for e in (mesh.next[c], mesh.prev[c]) if mesh.V[e] < v]
        if not known and v > 0:
            known = [self.rows[mesh.corners[v - 1][0]]]
        return tuple(known + [None, None])[:2]

    # After a split

    def read_split(self, decoder, parent, mesh, descent):
        """The rows of the finer level, and whether all arrived. Those that do not are their a. Nothing arrives
        without a decoder."""
        self.decoder = decoder
        self.mesh = mesh
        self.old = self.rows
        if self.attribute.of == MESH:
            return decoder is not None
        read = (self.read_vertices, self.read_faces, self.read_corners)[self.attribute.of]
        try:
            read(parent, descent)
        except Exhausted:
            return False
        return decoder is not None

    def read_vertices(self, parent, descent):
        V, opp, old = parent.V, parent.opp, self.old
        split = descent.split
        self.rows = old + [old[parents[0]] for parents in split.parents]
        if self.decoder is None:
            return
        for i, (c, f) in enumerate(split.origin):
            a, b = (old[u] for u in split.parents[i][:2])
            l = r = None
            if c != NONE and opp[c] != NONE:
                l, r = old[V[c]], old[V[opp[c]]]
            self.rows[len(old) + i] = self.row(a, b, l, r)

    def read_faces(self, parent, descent):
        self.rows = [self.old[F] for F in descent.face]
        if self.decoder is None:
            return
        for F in range(parent.faces):
            faces = range(descent.first[F], descent.first[F + 1])
            self.last = self.bit(self.kept[self.last + 2 * (len(faces) > 1)])
            if self.last == 1:
                continue
            for f in faces:
                if self.bit(self.same[0]) == 0:
                    self.rows[f] = self.row(self.old[F], self.beside(f)[0])

    def read_corners(self, parent, descent):
        mesh = self.mesh
        around = [self.around_corner(parent, sources) for sources in descent.sources]
        self.rows = [a or self.zero for a, _, _, _ in around]
        if self.decoder is None:
            return
        for v in range(mesh.vertices):
            if not mesh.corners[v]:
                continue
            if v < parent.vertices:
                self.read_old_vertex(v, around)
            else:
                self.read_new_vertex(v, around)

    def around_corner(self, parent, sources):
        """a, b, l, r of a corner"""
        old = self.old
        if not sources:
            return None, None, None, None
        if len(sources) == 1:
            return old[sources[0]], None, None, None
        a, b = sources
        c = 3 * (a // 3) + 3 - a % 3 - b % 3                # the third corner
        d = parent.opp[c]
        l = r = None
        if d != NONE and same(old[parent.next[c]], old[parent.prev[d]]) and same(old[parent.prev[c]], old[parent.next[d]]):
            l, r = old[c], old[d]
        return old[a], old[b], l, r

    def read_old_vertex(self, v, around):
        fan = self.mesh.corners[v]
        a = [around[c][0] for c in fan]
        self.last = self.bit(self.kept[self.last + 2 * (not all(same(x, a[0]) for x in a))])
        for i, c in enumerate(fan):
            if self.last == 1 or self.bit(self.same[1]) == 1:
                self.rows[c] = a[i] or self.zero
            else:
                self.rows[c] = self.read_other(fan[:i], a[i], around[c])

    def read_new_vertex(self, v, around):
        fan = self.mesh.corners[v]

        def expect_the_same(c, d):
            (a, b), (x, y) = around[c][:2], around[d][:2]
            return same(a, x) and same(b, y) or same(a, y) and same(b, x)

        self.rows[fan[0]] = self.row(*around[fan[0]])
        if len(fan) == 1:
            return
        self.last = self.bit(self.single[self.last + 2 * (not all(expect_the_same(c, fan[0]) for c in fan))])
        for i in range(1, len(fan)):
            c, before = fan[i], fan[i - 1]
            if self.last == 1 or self.bit(self.same[2 + (not expect_the_same(c, before))]) == 1:
                self.rows[c] = self.rows[before]
            else:
                self.rows[c] = self.read_other(fan[:i], self.rows[before], around[c])

    def read_other(self, fan, not_, around):
        """other(c, not), fan the corners before c"""
        others = []
        for c in reversed(fan):
            row = self.rows[c]
            if not any(same(row, x) for x in [not_] + others) and len(others) < 4:
                others.append(row)
        for n, row in enumerate(others):
            if self.bit(self.other[n]) == 1:
                return row
        return self.row(*around)


# ----------------------------------------------------------------------------------------------------------------
# 12.6 The rest
# ----------------------------------------------------------------------------------------------------------------

class Attributes:
    def __init__(self, head):
        self.channels = [Channel(a) for a in head.attributes]

    def levels(self):
        """those that every level has rows of"""
        return [channel for channel in self.channels if channel.attribute.on_levels()]

    def restore(self, number, turned, mesh):
        """From the numbering of level J to that of the restored mesh"""
        for channel in self.levels():
            rows = channel.rows
            if channel.attribute.of == VERTICES:
                placed = {}
                for v in range(mesh.vertices):
                    placed.setdefault(number[v], rows[v])
                channel.rows = [placed[n] for n in range(len(placed))]
            elif channel.attribute.of == CORNERS:
                channel.rows = []
                for f in range(mesh.faces):
                    a, b, c = rows[3 * f:3 * f + 3]
                    channel.rows += [a, c, b] if turned[f] else [a, b, c]

    def read_rest(self, decoder, positions, faces):
        """What is on no level, in the numbering of the restored mesh"""
        for channel in self.channels:
            channel.decoder = decoder
            attribute = channel.attribute
            if channel.rows is None:
                channel.rows = []
            if attribute.is_normals():
                for n in expected_normals(attribute.of, positions, faces):
                    channel.rows.append(channel.row(expected_row(attribute, n)))
            while len(channel.rows) < self.number_of_rows(attribute, positions, faces):
                channel.rows.append(channel.row_after(channel.rows))

    def number_of_rows(self, attribute, positions, faces):
        return (len(positions), len(faces), 3 * len(faces), 1)[attribute.of]

    def do_without_rest(self, positions, faces):
        """If the data end before it: isolated vertices, faces beyond those of level J have the row before"""
        for channel in self.levels():
            while len(channel.rows) < self.number_of_rows(channel.attribute, positions, faces):
                channel.rows.append(channel.rows[-1] if channel.rows else channel.zero)

    def digest(self):
        return xxh32(b"".join(struct.pack("<%dd" % len(row), *row)
                              for channel in self.channels for row in channel.rows))

    def put_in_order(self, order, number):
        """From the numbering of the restored mesh to that of the original (12.5)"""
        for channel in self.channels:
            rows, attribute = channel.rows, channel.attribute
            if rows is None:
                continue
            if attribute.of == VERTICES:
                channel.rows = [None] * len(rows)
                for v, n in enumerate(number):
                    channel.rows[n] = rows[v]
            elif attribute.of == CORNERS:
                channel.rows = [rows[3 * f + (start + k) % 3] for f, start in order for k in range(3)]
            elif attribute.is_faux_edges():
                channel.rows = [(sum((rows[f][0] >> (start + k) % 3 & 1) << k for k in range(3)),)
                                for f, start in order]
            elif attribute.of == FACES:
                channel.rows = [rows[f] for f, _ in order]

    def values(self):
        """Of each attribute that there are rows of: itself and what the rows stand for, row by row"""
        return [(channel.attribute, [channel.attribute.value(row) for row in channel.rows])
                for channel in self.channels if channel.rows is not None]


# ----------------------------------------------------------------------------------------------------------------
# 11. From the file to a mesh
# ----------------------------------------------------------------------------------------------------------------

class Result:
    """level, vertices (in model units), faces; outcome None if all is well. lattice: of level J, without features."""


class Decoder:
    def __init__(self, data):
        self.data = data
        self.head, self.offset = read_head(data)
        head = self.head
        self.glue = Glue() if head.features & 1 else None
        self.connectivity = Connectivity(head.rich)
        if head.compact:
            self.compact = Compact(head, self.glue)
        else:
            self.details = Details()
        self.level = NONE                                   # that mesh and positions are of
        self.mesh = None
        self.positions = None
        self.parents = []                                   # of the last split's new vertices
        self.restored = None                                # 12.3: lattice positions, faces
        self.exact = None                                   # 12.4
        self.order = None                                   # 12.5: (restored face, first corner), numbers of vertices
        self.attributes = Attributes(self.head) if head.features & 8 else None

    def decode(self, wanted):
        """Up to level `wanted`. Raises an Outcome; if that is Truncated, result() is what there is."""
        head = self.head
        while self.level < wanted:
            chunk = self.next_chunk("L")
            self.read_levels(chunk, wanted)
        if wanted == head.J:
            if lattice_digest(self.positions, self.mesh.V) != head.digest:
                raise Outcome("ChecksumMismatch", "digest of level J")
            self.read_features()

    def next_chunk(self, expected):
        """The next chunk that is not ancillary; it must be of the expected type."""
        while True:
            chunk = read_chunk(self.data, self.offset)
            if chunk is None:
                raise Outcome("Truncated", "a chunk %s should begin here" % expected)
            self.offset = chunk.end
            if "a" <= chunk.type <= "z":
                if not chunk.whole:
                    raise Outcome("Truncated", "in an ancillary chunk")
                continue
            if chunk.type != expected:
                raise corrupt("chunk %r where %s should be" % (chunk.type, expected))
            return chunk

    def read_levels(self, chunk, wanted):
        head = self.head
        a = b = self.level + 1
        while not head.ends[b]:
            b += 1
        if chunk.length != sum(head.bytes[a:b + 1]):
            raise corrupt("length of a chunk of levels")
        decoder = RangeDecoder(chunk.payload)
        for i in range(a, min(b, wanted) + 1):
            try:
                whole = self.read_level(decoder, i)
            except Exhausted:
                whole = False
            if not whole:
                if chunk.whole:
                    raise corrupt("the range decoder is exhausted in level %d" % i)
                raise Outcome("Truncated", "in level %d" % i)
        if self.level == b and not chunk.whole:
            raise Outcome("Truncated", "in the checksum behind level %d" % b)

    def read_level(self, decoder, i):
        """Whether the level is whole. Raises Exhausted if there is nothing of it."""
        head = self.head
        whole = True
        if head.kind[i] == BASE:
            self.mesh, self.positions = BaseMesh(decoder, head, self.glue).read()
            limit = 1 << (head.bits - head.shift[0])
            if head.compact and any(not 0 <= x < limit for p in self.positions for x in p):
                raise corrupt("a cell of the base mesh is out of range")
        elif head.kind[i] == PRECISE:
            self.positions, whole = self.compact.read_more_bits(
                decoder, self.mesh, self.positions, head.shift[i - 1] - head.shift[i], head.shift[i])
        else:
            split = self.connectivity.read(decoder, self.mesh, self.positions)
            triangles = refine(self.mesh, split)
            vertices = self.mesh.vertices + len(split.origin)
            if vertices != head.vertices[i] or len(triangles) != head.faces[i]:
                raise corrupt("number of vertices or faces of level %d" % i)
            mesh = Mesh(vertices, triangles)
            parent = self.mesh
            descent = Descent(parent, mesh, split) if self.attributes else None
            if head.compact:
                self.positions, whole = self.compact.read_split(
                    decoder, self.mesh, mesh, self.positions, split, head.shift[i])
            else:
                details, whole = self.details.read(decoder, self.mesh, self.positions, split)
                self.positions = synthesis(self.mesh, self.positions, split, details, head.lifting, self.glue)
            self.mesh = mesh
            self.parents = split.parents if head.compact else []
        if self.attributes and head.kind[i] != PRECISE:
            for channel in self.attributes.levels():
                if head.kind[i] == BASE:
                    channel.read_base(decoder, self.mesh, self.glue)
                else:
                    whole = channel.read_split(decoder if whole else None, parent, self.mesh, descent)
        self.level = i
        return whole

    def read_features(self):
        """12"""
        restoration = self.glue and Restoration(self.head, self.mesh, self.positions, self.glue)
        try:
            self.read_chunks_of_features(restoration)
        except Outcome as outcome:
            if outcome.name == "Truncated":
                self.do_without_rest(restoration)
            raise
        if self.order and self.attributes:
            self.attributes.put_in_order(*self.order)

    def do_without_rest(self, restoration):
        """What there is if the data end in what follows the levels"""
        restored = self.restored is not None
        if restoration and not restored:
            self.restored = restoration.glued()
        if self.attributes:
            if restoration and not restored:
                self.attributes.restore(restoration.number, restoration.turned, self.mesh)
            self.attributes.do_without_rest(*self.finest())
            if self.order:
                self.attributes.put_in_order(*self.order)

    def read_chunks_of_features(self, restoration):
        head = self.head
        for i in range(4):
            if not head.features >> i & 1:
                continue
            kind = FEATURE_CHUNKS[i]
            chunk = self.next_chunk(kind)
            if chunk.length != head.feature_length[kind]:
                raise corrupt("length of chunk %s" % kind)
            if not chunk.whole:
                raise Outcome("Truncated", "in chunk %s" % kind)
            if chunk.length < 4:
                raise corrupt("chunk %s is too short" % kind)
            digest = int.from_bytes(chunk.payload[:4], "little")
            decoder = RangeDecoder(chunk.payload[4:])
            try:
                computed = self.read_R(decoder, restoration) if kind == "R" else getattr(self, "read_" + kind)(decoder)
            except Exhausted:
                raise corrupt("the range decoder is exhausted in chunk %s" % kind)
            if computed != digest:
                raise Outcome("ChecksumMismatch", "digest of chunk %s" % kind)

    def finest(self):
        """The restored mesh, or level J if there is nothing to restore: lattice positions, faces."""
        V = self.mesh.V
        return self.restored or (self.positions, [tuple(V[c:c + 3]) for c in range(0, len(V), 3)])

    def read_R(self, decoder, restoration):
        self.restored = restoration.read(decoder)
        if self.attributes:
            self.attributes.restore(restoration.number, restoration.turned, self.mesh)
        return lattice_digest(self.restored[0], [v for t in self.restored[1] for v in t])

    def read_O(self, decoder):
        positions, faces = self.finest()
        self.order = Order(self.mesh, len(positions), faces).read(decoder)
        order, number = self.order
        told = [number[faces[f][(start + k) % 3]] for f, start in order for k in range(3)]
        return xxh32(b"".join(struct.pack("<I", n) for n in number + told))

    def read_X(self, decoder):
        self.exact = read_exact(decoder, self.head, self.finest()[0])
        return xxh32(b"".join(struct.pack("<3d", *p) for p in self.exact))

    def read_A(self, decoder):
        self.attributes.read_rest(decoder, *self.finest())
        return self.attributes.digest()

    def result(self):
        """Vertices in model units and faces of what there is."""
        head, mesh, positions = self.head, self.mesh, self.positions
        V = mesh.V
        faces = [tuple(V[c:c + 3]) for c in range(0, len(V), 3)]
        if self.restored:
            positions, faces = self.restored
        shift = head.shift[self.level]
        if self.exact:
            vertices = self.exact
        elif shift > 0:
            parents = self.parents if mesh.vertices < head.vertices[head.J] else []
            vertices = [model_position(head, [x / 16 for x in p])
                        for p in shown(mesh, positions, shift, parents, head.bits, self.glue)]
        else:
            vertices = [model_position(head, P) for P in positions]
        if self.order:
            order, number = self.order
            placed = [None] * len(vertices)
            for v, n in enumerate(number):
                placed[n] = vertices[v]
            vertices = placed
            faces = [tuple(number[faces[f][(start + k) % 3]] for k in range(3)) for f, start in order]
        return vertices, faces


def output_digest(vertices, faces):
    data = [struct.pack("<3d", *p) for p in vertices] + [struct.pack("<3I", *t) for t in faces]
    return xxh32(b"".join(data))


def write_obj(path, vertices, faces):
    with open(path, "w") as out:
        for p in vertices:
            out.write("v %r %r %r\n" % p)
        for t in faces:
            out.write("f %d %d %d\n" % tuple(v + 1 for v in t))


def main():
    parser = argparse.ArgumentParser(description="Reference decoder of .wmc mesh files, version 0.5.")
    parser.add_argument("file")
    parser.add_argument("--level", type=int, help="the level to decode; the finest if not given")
    parser.add_argument("--output", help="an OBJ file to write")
    parser.add_argument("--digest", action="store_true", help="print level, vertices, faces, XXH32 of what comes out")
    options = parser.parse_args()
    with open(options.file, "rb") as source:
        data = source.read()
    decoder = None
    failed = False
    try:
        decoder = Decoder(data)
        wanted = decoder.head.J if options.level is None else options.level
        if not 0 <= wanted <= decoder.head.J:
            print("there are levels 0 to %d" % decoder.head.J, file=sys.stderr)
            return 2
        decoder.decode(wanted)
    except Outcome as outcome:
        print("%s (%d): %s" % (outcome.name, OUTCOMES[outcome.name], outcome.why), file=sys.stderr)
        failed = True
        if outcome.name != "Truncated" or decoder is None or decoder.level == NONE:
            return 1
    vertices, faces = decoder.result()
    if options.output:
        write_obj(options.output, vertices, faces)
    if options.digest:
        print("level %d vertices %d faces %d xxh32 %08x" % (
            decoder.level, len(vertices), len(faces), output_digest(vertices, faces)))
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
