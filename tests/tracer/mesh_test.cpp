// Meshes from OBJ files, and why some are refused.
#include "geometry/mesh.hpp"

#include "catch.hpp"
#include "folder.hpp"
#include "images/image.hpp"

#include <cmath>
#include <fstream>

namespace {

const std::string faces = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\n";

tracer::Mesh mesh_of(const std::string& obj, const std::string& mtl = {}) {
    const Folder folder;
    std::ofstream{folder.file("a.mtl")} << mtl;
    std::ofstream{folder.file("a.obj")} << "mtllib a.mtl\n" << obj;
    return tracer::read_mesh(folder.file("a.obj"));
}

}  // namespace

TEST_CASE("a mesh has the triangles and materials of its file") {
    const tracer::Mesh mesh = mesh_of(faces + "f 1 2 3\nusemtl lamp\nf 1 2 3 4\nusemtl coat\nf 1 3 4\n",
                                      "newmtl lamp\nKd 0 0 0\nKe 4 5 6\nnewmtl coat\nKd 0.1 0.2 3\nKs 1 1 1\nNs 98\n");
    REQUIRE(mesh.triangles.size() == 4);
    REQUIRE(mesh.materials.size() == 3);
    CHECK(mesh.triangles[0].b == glm::vec3{2, 0, 0});
    CHECK(mesh.materials[mesh.material_of[0]].emission == glm::vec3{0});  // a face without a material
    CHECK(mesh.materials[mesh.material_of[1]].emission == glm::vec3{4, 5, 6});
    CHECK(mesh.materials[mesh.material_of[2]].emission == glm::vec3{4, 5, 6});
    const tracer::MeshMaterial& coat = mesh.materials[mesh.material_of[3]];
    CHECK(coat.albedo == glm::vec3{0.1f, 0.2f, 1});
    CHECK(std::abs(coat.alpha - std::sqrt(0.02f)) <= 1e-6f);
    CHECK(coat.index == 1.5f);
}

TEST_CASE("a file that is no mesh is refused with the reason") {
    using Catch::Matchers::Contains;
    CHECK_THROWS_WITH(tracer::read_mesh("no/such.obj"), Contains("cannot read no/such.obj"));
    CHECK_THROWS_WITH(mesh_of("# nothing\n"), Contains("there is no face in it"));
    CHECK_THROWS_WITH(mesh_of(faces + "f 1 2 9\n"), Contains("none of its vertices"));
    CHECK_THROWS_WITH(mesh_of(faces + "usemtl red\nf 1 2 3\n", "newmtl red\nKd -1 0 0\n"),
                      Contains("a colour of the material red"));
}
