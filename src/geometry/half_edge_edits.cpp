#include <algorithm>
#include <utility>

#include "core/assert.h"
#include "geometry/half_edge_mesh.h"

// Local edits of HalfEdgeMesh. In the comments h runs from a to b, c is the third vertex of its face and d that of the
// face of its twin g.
namespace divot::geometry {

void HalfEdgeMesh::reserve(std::size_t vertices, std::size_t faces) {
  origin_.reserve(3 * faces), twin_.reserve(3 * faces), outgoing_.reserve(vertices);
}

void HalfEdgeMesh::set_twin(std::uint32_t h, std::uint32_t twin) {
  twin_.set(h, twin, [this](std::uint32_t i) { return grid_.twin(i); });
}

void HalfEdgeMesh::set_outgoing(std::uint32_t v, std::uint32_t h) {
  outgoing_.set(v, h, [this](std::uint32_t i) { return grid_.outgoing(i); });
}

void HalfEdgeMesh::link(std::uint32_t a, std::uint32_t b) {
  if (a != kNone) set_twin(a, b);
  if (b != kNone) set_twin(b, a);
}

// Finds outgoing(v) from any half-edge `h` that starts there: back clockwise to the boundary, or once round.
void HalfEdgeMesh::settle_outgoing(std::uint32_t v, std::uint32_t h) {
  const std::uint32_t first = h;
  std::uint32_t lowest = h;
  do {
    lowest = std::min(lowest, h);
    if (twin(h) == kNone) {
      lowest = h;
      break;
    }
    h = next(twin(h));
  } while (h != first);
  set_outgoing(v, lowest);
}

bool HalfEdgeMesh::are_neighbours(std::uint32_t a, std::uint32_t b) const {
  bool found = false;
  for_each_neighbour(a, [&](std::uint32_t v) { found |= v == b; });
  return found;
}

// Makes (a, m, c) of the face (a, b, c) and appends (m, b, c). Returns the half-edge from m to b, not yet linked.
std::uint32_t HalfEdgeMesh::split_face(std::uint32_t h, std::uint32_t vertex) {
  const std::uint32_t n = next(h), fresh = half_edge_count();
  DIVOT_ASSERT(fresh < kNone - 3);
  origin_.insert(origin_.end(), {vertex, origin_[n], origin_[prev(h)]});
  for (int k = 0; k < 3; ++k) twin_.push_back(kNone, [this](std::uint32_t i) { return grid_.twin(i); });
  link(fresh + 1, twin(n));
  origin_[n] = vertex;
  link(fresh + 2, n);
  return fresh;
}

std::uint32_t HalfEdgeMesh::split_edge(std::uint32_t h, std::uint32_t vertex) {
  DIVOT_ASSERT(vertex == kNone || outgoing(vertex) == kNone);
  const std::uint32_t g = twin(h), middle = vertex == kNone ? vertex_count() : vertex;
  if (vertex == kNone) outgoing_.push_back(kNone, [this](std::uint32_t i) { return grid_.outgoing(i); });
  const std::uint32_t onward = split_face(h, middle);
  if (g != kNone) {
    link(h, split_face(g, middle));
    link(g, onward);
    settle_outgoing(origin_[prev(g)], prev(g));
  }
  for (const std::uint32_t e : {h, onward, next(onward), prev(h)}) settle_outgoing(origin_[e], e);
  return middle;
}

// h runs from a to the vertex m; the faces (a, m, c) and (m, b, c) become (a, b, c), and so on the other side, where g
// runs from b to m.
std::array<HalfEdgeMesh::Moved, 2> HalfEdgeMesh::unsplit_edge(std::uint32_t h) {
  const std::uint32_t m = target(h), a = origin_[h], c = origin_[prev(h)];
  const auto close = [&](std::uint32_t kept) {
    const std::uint32_t inner = next(kept), onward = next(twin(inner)), beyond = twin(next(onward));
    origin_[inner] = target(onward);
    set_twin(inner, kNone);
    link(inner, beyond);
    return onward;
  };
  const std::uint32_t onward = close(h), g = twin(onward);
  std::uint32_t d = kNone;
  std::array<std::uint32_t, 2> gone{face_of(onward), kNone};
  set_twin(h, kNone);
  if (g != kNone) {
    gone[1] = face_of(close(g));
    link(h, g);
    d = origin_[prev(g)];
    set_outgoing(d, prev(g));
  }
  set_outgoing(m, kNone);
  const std::uint32_t b = target(h);
  set_outgoing(a, h), set_outgoing(b, next(h)), set_outgoing(c, prev(h));

  // The higher face goes first, so that the lower one is not the one that moves.
  std::array<Moved, 2> moved;
  if (gone[1] != kNone && gone[0] < gone[1]) std::swap(gone[0], gone[1]);
  std::array<std::uint32_t, 10> settle{a, b, c, d, kNone, kNone, kNone, kNone, kNone, kNone};
  for (std::size_t k = 0; k < 2 && gone[k] != kNone; ++k) {
    moved[k] = {gone[k], face_count() - 1};
    const auto corners = remove_face(gone[k]);
    std::copy(corners.begin(), corners.end(), settle.begin() + 4 + 3 * static_cast<std::ptrdiff_t>(k));
  }
  for (const std::uint32_t v : settle)
    if (v != kNone) settle_outgoing(v, outgoing(v));
  return moved;
}

bool HalfEdgeMesh::flip_edge(std::uint32_t h) {
  const std::uint32_t g = twin(h);
  if (g == kNone) return false;
  const std::uint32_t hn = next(h), hp = prev(h), gn = next(g), gp = prev(g);
  const std::uint32_t a = origin_[h], b = origin_[g], c = origin_[hp], d = origin_[gp];
  if (c == d || are_neighbours(c, d)) return false;

  // (a, b, c) and (b, a, d) become (d, c, a) and (c, d, b), each in its old place.
  const std::uint32_t bc = twin(hn), ca = twin(hp), ad = twin(gn), db = twin(gp);
  origin_[h] = d, origin_[hn] = c, origin_[hp] = a;
  origin_[g] = c, origin_[gn] = d, origin_[gp] = b;
  for (const std::uint32_t e : {hn, hp, gn, gp}) set_twin(e, kNone);
  link(hn, ca), link(hp, ad), link(gn, db), link(gp, bc);
  for (const std::uint32_t e : {h, hn, hp, gp}) settle_outgoing(origin_[e], e);
  return true;
}

// The link condition: a and b share no neighbours but those across the edge, with the outside of the boundary as one
// more vertex; and the surface is more than one triangle or one tetrahedron.
bool HalfEdgeMesh::can_collapse(std::uint32_t h) const {
  const std::uint32_t g = twin(h), a = origin_[h], b = target(h);
  if (g != kNone && is_boundary(a) && is_boundary(b)) return false;
  if (g == kNone && twin(next(h)) == kNone && twin(prev(h)) == kNone) return false;

  std::uint32_t shared = 0, valence_a = 0, valence_b = 0;
  for_each_neighbour(a, [&](std::uint32_t v) { ++valence_a, shared += are_neighbours(b, v); });
  for_each_neighbour(b, [&](std::uint32_t) { ++valence_b; });
  if (shared != (g == kNone ? 1u : 2u)) return false;
  const bool tetrahedron = valence_a == 3 && valence_b == 3 && !is_boundary(a) && !is_boundary(b);
  return !tetrahedron;
}

// Joins what lies beyond the two other edges of the face of `h`, and gives a and c half-edges that outlive it.
void HalfEdgeMesh::close_face(std::uint32_t h) {
  const std::uint32_t a = origin_[h], c = origin_[prev(h)];
  const std::uint32_t beyond_bc = twin(next(h)), beyond_ca = twin(prev(h));
  link(beyond_bc, beyond_ca);
  set_outgoing(a, beyond_bc != kNone ? next(beyond_bc) : beyond_ca);
  set_outgoing(c, beyond_bc != kNone ? beyond_bc : next(beyond_ca));
}

// Moves the last face into the place of `face`, whose vertices no longer lead to it. Returns the vertices of the moved.
std::array<std::uint32_t, 3> HalfEdgeMesh::remove_face(std::uint32_t face) {
  const std::uint32_t last = face_count() - 1;
  std::array<std::uint32_t, 3> moved{kNone, kNone, kNone};
  for (std::uint32_t i = 0; i < 3 && face != last; ++i) {
    const std::uint32_t from = 3 * last + i, to = 3 * face + i;
    moved[i] = origin_[to] = origin_[from];
    set_twin(to, kNone);
    link(to, twin(from));
    if (outgoing(moved[i]) == from) set_outgoing(moved[i], to);
  }
  origin_.resize(3 * std::size_t{last});
  twin_.shrink(3 * std::size_t{last});
  return moved;
}

bool HalfEdgeMesh::collapse_edge(std::uint32_t h) {
  if (!can_collapse(h)) return false;
  const std::uint32_t g = twin(h), a = origin_[h], b = target(h), c = origin_[prev(h)];
  const std::uint32_t d = g == kNone ? kNone : origin_[prev(g)];

  // Everything that started at b starts at a; then the faces on both sides of the edge close up.
  for_each_outgoing(b, [&](std::uint32_t e) { origin_[e] = a; });
  set_outgoing(b, kNone);
  close_face(h);
  if (g != kNone) close_face(g);

  // The higher face goes first, so that the lower one is not the one that moves.
  std::array<std::uint32_t, 3> moved_first{kNone, kNone, kNone};
  if (g != kNone) moved_first = remove_face(face_of(std::max(h, g)));
  const std::array<std::uint32_t, 3> moved_last = remove_face(face_of(std::min(h, g)));
  for (const std::uint32_t v :
       {a, c, d, moved_first[0], moved_first[1], moved_first[2], moved_last[0], moved_last[1], moved_last[2]})
    if (v != kNone) settle_outgoing(v, outgoing(v));
  return true;
}

}  // namespace divot::geometry
