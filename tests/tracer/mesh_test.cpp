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

TEST_CASE("a small mesh is enlarged, and one far from the origin moved there") {
    const auto square = [](const std::string& low, const std::string& high) {
        return mesh_of("v " + low + " 0 0\nv " + high + " 0 0\nv " + high + " 1e-30 0\nf 1 2 3\n");
    };
    CHECK(square("-1", "1").placement.scale == 1);
    CHECK(square("0", "1000").placement.center == glm::vec3{0});
    const tracer::Mesh small = square("-9.765625e-4", "9.765625e-4"), far = square("5000000", "5000002");
    CHECK(small.triangles[0].b.x == 1);
    CHECK(far.triangles[0].b.x == 1);
    CHECK(far.lower.x == -1);
    CHECK(far.placement(glm::vec3{5000003, 0, 0}).x == 2);
    for (const char* size : {"1e-44", "1e-30", "1e20", "3e38"}) {
        INFO(size);
        const glm::vec3 extent = square("-" + std::string{size}, size).upper;
        CHECK(extent.x > 0);
        CHECK(extent.x < 3e6f);
    }
}

TEST_CASE("what a file asks for and does not get is said, and triangles without an area are left out") {
    const tracer::Mesh mesh = mesh_of(faces + "v 4 0 0\nmtllib none.mtl\nf 1 2 5\nf 1 1 2\nusemtl wood\nf 1 2 3\n",
                                      "newmtl wood\nKd 0 0 0\nmap_Kd wood.png\nd 0.5\nPm 1\n");
    REQUIRE(mesh.triangles.size() == 1);
    REQUIRE(mesh.material_of.size() == 1);
    CHECK(mesh.materials[mesh.material_of[0]].albedo != glm::vec3{0});
    REQUIRE(mesh.notes.size() == 4);
    CHECK(mesh.notes[0].find("none.mtl") != std::string::npos);
    CHECK(mesh_of(faces + "f 1 2 3\n").notes.empty());
}

TEST_CASE("a file that is no mesh is refused with the reason") {
    using Catch::Matchers::Contains;
    CHECK_THROWS_WITH(tracer::read_mesh("no/such.obj"), Contains("cannot read no/such.obj"));
    CHECK_THROWS_WITH(mesh_of("# nothing\n"), Contains("there is no face in it"));
    CHECK_THROWS_WITH(mesh_of(faces + "v 4 0 0\nf 1 2 5\n"), Contains("there is no face in it"));
    CHECK_THROWS_WITH(mesh_of(faces + "f 1 2 9\n"), Contains("none of its vertices"));
    CHECK_THROWS_WITH(mesh_of(faces + "usemtl red\nf 1 2 3\n", "newmtl red\nKd -1 0 0\n"),
                      Contains("a colour of the material red"));
}
