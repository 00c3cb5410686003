// The calls of docs/which-call.md and docs/coming-from.md, as they are written there:
// check_calls.sh looks for each in this source, and this program says whether they answer.
#include <array>
#include <cstdio>
#include <shaftcull/shaftcull.hpp>
#include <vector>

using namespace shaftcull;

namespace {

int failures = 0;
void expect(bool right, const char* what) {
  if (right) return;
  std::printf("wrong: %s\n", what);
  ++failures;
}

struct Object {
  float lo[3];
  float hi[3];
};

const Box box{{0, 0, 0}, {1, 1, 1}};
const std::vector<Box> boxes = {box, {{4, 0, 0}, {5, 1, 1}}, {{0, 40, 0}, {1, 41, 1}}};
const std::vector<std::uint32_t> indices = {0, 1, 2};
const std::vector<Vec3> vertices = {{4, 0, 0}, {5, 0, 0}, {4, 1, 1}};
constexpr std::array<float, 16> matrix = {1, 0, 0,     0,      0, 1, 0, 0,
                                          0, 0, 1.04F, -2.04F, 0, 0, 1, 0};
constexpr ClipDepth depth = ClipDepth::minus_one_to_one;

void make_more(const ConvexHull& view) {
  const Vec3 light{0, 99, 9};
  expect(keeps(casters(view, light), Box{light, light}), "casters of a light");
  const BoxStream a(std::span<const Box>(boxes).first(2));
  const BoxStream& b = a;
  const std::vector<IndexPair> pairs = {{0, 1}};
  std::vector<CompiledShaft> shafts(1);
  compile_batch(a, b, pairs, shafts);
  expect(shafts[0].formed(), "batch");
}

void ask_of_all_pairs() {
  const PatchSet patches(boxes);
  Occluders occluders;
  occluders.add_solids(std::vector<Box>{{{2, -1, -1}, {3, 2, 2}}});
  const MeshView triangles = mesh_view(vertices, indices);
  occluders.add_mesh(triangles, {.region = patches.box()});
  occluders.add_found(find_solids(triangles));
  std::size_t batches = 0;
  const auto deliver = [&](const SightBatch&) { ++batches; };
  const SightCounts counts = visibility(patches, occluders, deliver);
  const std::vector<Vec3> from{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<Vec3> to{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}};
  const double factor = view_factor(from, to);
  expect(factor > 0.1998 && factor < 0.1999, "view factor");
  const std::vector<std::size_t> one{0, 4};
  const PatchSet a(from, one);
  const PatchSet b(to, one);
  const std::vector<PatchPair> pair{{0, 0}};
  const std::vector<std::size_t> none{0, 0};
  const UndecidedPairs pairs{pair, none, {}};
  std::vector<float> fractions(1);
  visible_fractions(a, b, occluders, pairs, fractions);
  expect(fractions[0] == 1, "rays");
  const PatchSet& facets = a;
  const std::vector<Vec3> directions{{0, 1, 0}};
  std::vector<float> lit(facets.size());
  lit_fractions(facets, occluders, directions, lit);
  expect(lit[0] >= 0 && lit[0] <= 1, "lights");
  const ViewFactors factors = view_factors(facets, occluders);
  expect(factors.sum[0] == 0, "view factors");
  expect(counts.occluded == 1 && counts.total() == 3 && batches != 0, "visibility");
}

void make_volumes() {
  const Box a = box;
  const Box b{{9, 0, 0}, {10, 1, 1}};
  const Box light{{0, 0, 9}, {1, 1, 9}};
  const Box occluder = box;
  const Box body = box;
  const Vec3 travel{9, 0, 0};
  const Vec3 direction{1, 0, 0};
  const Vec3 sun{0, 1, 0};
  const std::vector<Plane> planes = {{{1, 0, 0}, 3}};
  const std::vector<Vec3>& points = vertices;
  const std::vector<Vec3> p = {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<Vec3> q = {{9, 0, 0}, {9, 1, 0}, {9, 0, 1}};
  const ConvexHull view = frustum(matrix, depth);
  expect(keeps(compile(a, b), boxes[1]), "between");
  expect(!keeps(compile(a, b, planes), boxes[1]), "cut by a plane");
  expect(compile(a, b, Contact::open).contact() == Contact::open, "open contact");
  expect(compile(a, b, planes, Contact::open).contact() == Contact::open,
         "planes and open contact");
  expect(keeps(swept(body, travel), boxes[1]), "swept");
  expect(keeps(swept_infinite(body, direction), boxes[1]), "swept without end");
  expect(!keeps(shadow(light, occluder), light), "shadow");
  expect(keeps(casters_towards(view, sun), Box{{0, 99, 9}, {1, 99, 9}}), "casters of a sun");
  expect(between_polygons(p, q).points().size() == 6, "between polygons");
  expect(ConvexHull(points).points().size() == 3, "hull");
  make_more(view);
}

void ask() {
  const CompiledShaft shaft = compile(box, boxes[1]);
  const std::vector<CompiledShaft> shafts = {shaft};
  const std::vector<Object> objects = {{{4, 0, 0}, {5, 1, 1}}};
  const BoxStream walls(std::vector<Box>{{{2, -9, -9}, {3, 9, 9}}});
  const TriangleTree triangles = TriangleTree(mesh_view(vertices, indices));
  expect(BoxStream(strided(objects, &Object::lo, &Object::hi)).size() == 1, "records");
  expect(keeps(shaft, box), "one box");
  expect(classify(shaft, box) == Answer::inside, "the answer of one box");
  expect(any(shaft, triangles), "triangles");
  expect(any(shaft, triangles, {.triangle_test = TriangleTest::vertices}), "by vertices");
  expect(!any(compile(box, box), triangles), "triangles in a box");
  expect(occluded(shaft, walls), "occluded");

  BoxTree tree = BoxTree(boxes);
  tree.set_layers(std::vector<std::uint32_t>{1, 2, 4});
  tree.update(indices, boxes);
  tree.refit();
  tree.update(boxes);
  if (tree.sah_ratio() > 2) tree.rebuild();
  std::vector<std::uint32_t> kept;
  const std::vector<Vec3>& corners = vertices;
  const Vec3 from{-1, 0.5F, 0.5F};
  const Vec3 to{9, 0.5F, 0.5F};
  const Vec3 direction{10, 0, 0};
  const Vec3 travel{10, 0, 0};
  const Box& body = box;
  const std::uint32_t me = 0;
  const std::uint32_t mask = 0b110;
  const std::vector<std::uint32_t> candidates = {1, 2};
  expect(list(shaft, tree, kept) == 2, "list");
  expect(list(shaft, tree, kept, {.limit = 1}) == 1, "a list with an end");
  expect(list(shaft, tree, kept, {.only = candidates}) == 1 && kept[0] == 1, "candidates");
  expect(list(shaft, triangles, kept) == 1, "list of triangles");
  expect(list(compile(box, box), tree, kept) == 1, "what meets a box");
  expect(list(compile(Box{from, from}, Box{to, to}), tree, kept) == 2, "what meets a segment");
  expect(list(swept(Box{from, from}, direction), tree, kept) == 2, "what meets a ray");
  expect(list(swept(box, travel), tree, kept) == 2, "what meets a cast");
  expect(list(ConvexHull(corners), tree, kept) == 1, "what meets a hull");
  expect(list(frustum(matrix, depth), tree, kept) == 1, "what is in view");
  expect(list(frustum(matrix, depth, HullTest::conservative), tree, kept) == 1,
         "what is in view, by its planes alone");
  expect(first_contact(swept(body, travel), tree).index == 0, "the body itself");
  expect(first_contact(swept(body, travel), tree, {.exclude = {me}}).index == 1, "contact");
  const float skin = 0.25F;
  expect(first_contact(swept(inflated(body, skin), travel), tree, {.exclude = {me}}).time <
             first_contact(swept(body, travel), tree, {.exclude = {me}}).time,
         "what comes nearer than a skin");
  expect(count(shaft, tree, {.layer_mask = {mask}}) == 1, "layers");
  IndexLists lists;
  list_many(shafts, tree, lists);
  expect(lists[0].size() == 2, "lists");
}

}  // namespace

int main() {
  make_volumes();
  ask_of_all_pairs();
  ask();
  std::printf(failures == 0 ? "all calls answer\n" : "not all calls answer\n");
  return failures == 0 ? 0 : 1;
}
