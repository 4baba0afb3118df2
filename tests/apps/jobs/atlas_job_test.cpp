// Files of layouts of runs that were stopped before all charts had a map: their formats, and their
// proofs.
#include "majorant/apps/jobs/atlas_job.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

#include "counted_stop.h"
#include "expected_error.h"
#include "majorant/apps/jobs/check_map.h"
#include "majorant/apps/jobs/object_layouts.h"
#include "majorant/apps/jobs/write_map.h"
#include "majorant/framework/error.h"
#include "majorant/io/read_mesh.h"
#include "mesh/joined_meshes.h"
#include "mesh/surfaces_of_any_genus.h"
#include "mesh/test_meshes.h"

namespace majorant {
namespace {

// Returns five sheets of quads, one above the other.
PolygonMesh sheets() {
  PolygonMesh mesh = grid(3, bumpy);
  for (int k = 1; k < 5; ++k) mesh = together(mesh, moved(grid(3, bumpy), {0, 0, 3.0 * k}));
  IndexLists quads;
  for (std::size_t p = 0; p < mesh.polygons.size(); p += 2) {
    const auto first = mesh.polygons[p], second = mesh.polygons[p + 1];
    quads.push_back({first[0], first[1], first[2], second[2]});
  }
  mesh.polygons = quads;
  mesh.polygon_lines.clear();
  mesh.file = "sheets.obj";
  return mesh;
}

// A job that can be stopped, and its record.
struct Stopping {
  explicit Stopping(const CountedStop& stop) : record(stop.check()), job(record) {
    job.open(sheets(), {});
    job.energy = "symmetric-dirichlet";
    job.solve();
    if (!job.place()) throw InvalidArgument("it has no place in the square");
    job.prove();
  }
  RunRecord record;
  AtlasJob job;
};

// Returns a job that was stopped when some of its charts had a map.
std::unique_ptr<Stopping> stopped_half_way() {
  const CountedStop never;
  const Stopping whole(never);
  constexpr long kTries = 60;
  for (long k = 1; k < kTries; ++k) {
    try {
      auto run = std::make_unique<Stopping>(CountedStop(never.polls() * k / kTries));
      if (!run->job.atlas.is_complete() && run->job.atlas.charts.size() > 1) return run;
    } catch (const Stopped&) {
    }
  }
  throw InvalidArgument("no stop leaves a part of the charts");
}

class PartialLayout : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void SetUp() override { std::filesystem::create_directories(folder_); }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  const std::unique_ptr<Stopping> run_ = stopped_half_way();
  const AtlasJob& job_ = run_->job;

 private:
  const std::filesystem::path folder_ =
      std::filesystem::temp_directory_path() /
      ("partial_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()));
};

TEST_F(PartialLayout, IsWrittenProvenAndReported) {
  EXPECT_EQ(atlas_report(job_).result["complete"], false);
  EXPECT_EQ(atlas_report(job_).status, "interrupted");
  const MapFile file = atlas_file(job_);
  for (const char* const name : {"a.obj", "a.vtu", "a.msh"}) {
    const std::string out = path(name);
    write_map(out, file, job_.polygons.get(), {},
              proof_of_file(out, proof_request(job_, out), file, {}));
    const MapFile read = read_map(out);
    EXPECT_EQ(read.cells.rows(), file.cells.rows());
    EXPECT_LT(to_size(static_cast<Index>(read.cells.rows())), 2 * job_.polygons->polygons.size());
    // The file does not cover the whole surface.
    ProofRequest whole = proof_request(job_, out);
    whole.coverage = ProofRequest::Coverage::Whole;
    whole.unmapped.reset();
    EXPECT_THROW(certification(out, whole, extension(out) == ".msh" ? &file : nullptr)(out), Error);
  }
  // `check` judges from the file alone.
  for (const char* const name : {"a.obj", "a.vtu"}) {
    const MapFile read = read_map(path(name));
    EXPECT_FALSE(read.is_complete);
    const RunRecord record;
    CheckRequest request;
    request.name = name;
    request.surface = job_.polygons.get();
    request.certify = true;
    const MapCheck check(read, request, record);
    EXPECT_EQ(check.proof.verdict(), ProofStatus::Proven) << check.proof.first_defect();
    EXPECT_FALSE(check.findings.violated());
    EXPECT_NE(check.proof.surface.detail.find("not mapped"), std::string::npos);
  }
}

TEST_F(PartialLayout, KeepsFacesThatHaveNoMap) {
  const MapFile file = atlas_file(job_);
  const std::string out = path("a.obj");
  write_map(out, file, job_.polygons.get(), {},
            proof_of_file(out, proof_request(job_, out), file, {}));
  const PolygonMesh mesh = read_mesh(out);
  ASSERT_EQ(mesh.polygons.size(), job_.polygons->polygons.size());
  EXPECT_TRUE(mesh.has_partial_layout);
  std::size_t without = 0;
  for (std::size_t p = 0; p < mesh.polygons.size(); ++p)
    without += mesh.polygon_texcoords[p].empty();
  EXPECT_GT(without, 0u);
  EXPECT_LE(without, job_.atlas.unmapped.faces.size());
}

// A file with a missing cell that it does not declare is refused.
TEST_F(PartialLayout, UndeclaredMissingCellsAreRefused) {
  const MapFile file = atlas_file(job_);
  std::vector<Index> cells;
  for (Index c = 1; c < file.cells.rows(); ++c) cells.push_back(c);
  const std::vector<Index> but_a_face(cells.begin() + 1, cells.end());  // a polygon has two cells
  for (const MapFile& fewer : {with_cells(file, cells), with_cells(file, but_a_face)})
    for (const char* const name : {"a.obj", "a.vtu"}) {
      const std::string out = path(name);
      EXPECT_THROW(write_map(out, fewer, job_.polygons.get(), {},
                             proof_of_file(out, proof_request(job_, out), fewer, {})),
                   Error);
      EXPECT_FALSE(std::filesystem::exists(out));
    }
}

TEST_F(PartialLayout, OtherFormatsNameTheFormatsThatHoldIt) {
  const MapFile file = atlas_file(job_);
  MapFormats formats;
  formats.msh = MshContent::Surface;
  for (const char* const name : {"a.ply", "a.glb", "a.gltf", "a.msh"})
    expect_contains(error_message(ErrorKind::Unsupported,
                                  [&] {
                                    write_map(
                                        path(name), file, job_.polygons.get(), formats,
                                        proof_of_file(path(name), proof_request(job_, path(name)),
                                                      file, formats));
                                  }),
                    {name, ".obj or .vtu"});
}

TEST(Objects, AStopLeavesTheObjectsThatHaveALayout) {
  PolygonMesh mesh = sheets();
  const auto sheet = static_cast<Index>(mesh.polygons.size() / 5);
  for (Index k = 0; k < 5; ++k)
    mesh.directives.emplace_back(k * sheet, "o sheet" + std::to_string(k));
  std::atomic<bool> interrupt = false;
  RunRecord record(INFINITY, 1000, &interrupt);
  int done = 0;
  UnwrappedObjects objects = unwrap_objects(mesh, record, [&](PolygonMesh object, AtlasJob& job) {
    if (done++ == 2) interrupt = true;
    job.open(std::move(object), {});
    job.solve();
    if (!job.place()) throw InvalidArgument("it has no place in the square");
    job.prove();
  });
  EXPECT_EQ(objects.layouts.size(), 2u);
  EXPECT_FALSE(objects.is_complete);
  EXPECT_EQ(objects.status, Status::Interrupted);
  const MapFile file = map_of_objects(std::move(objects.layouts));
  const auto folder = std::filesystem::temp_directory_path();
  for (const char* const name : {"partial_objects.obj", "partial_objects.vtu"}) {
    const std::string out = (folder / name).string();
    write_map(out, file, &mesh, {}, proof_of_objects(out, mesh));
    std::filesystem::remove(out);
  }
}

}  // namespace
}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
