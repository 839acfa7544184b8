// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

// The module of surface fusion: Open3D's VoxelBlockGrid.

#include <cmath>
#include <stdexcept>

#include <open3d/core/EigenConverter.h>
#include <open3d/geometry/TriangleMesh.h>
#include <open3d/t/geometry/Image.h>
#include <open3d/t/geometry/VoxelBlockGrid.h>
#include <open3d/utility/Logging.h>

#include "apps/fusion/surface_fusion.h"
#include "msc_vo/text/format_text.h"

namespace msc_vo {

namespace {

namespace o3c = open3d::core;
namespace o3g = open3d::t::geometry;

constexpr int kBlockResolution = 8;      // voxels per edge of a block
constexpr float kTruncation = 4.0f;      // voxels
constexpr double kBytesPerVoxel = 12.0;  // distance, weight, three colours
constexpr int64_t kInitialBlocks = 4096;
constexpr int32_t kFarBlock = 1 << 24;  // beyond what `float` coordinates of voxels resolve
constexpr double kCellGrowth = 1.25;    // from one try of Simplify() to the next

const o3c::Device kCpu("CPU:0");

o3c::Tensor TensorOf(const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic>& matrix) {
  return o3c::eigen_converter::EigenMatrixToTensor(matrix);
}

// `pixel_center`: coordinates of the centre of the first pixel, which are 0 in `camera`.
o3c::Tensor Intrinsics(const PinholeCamera& camera, double pixel_center) {
  Eigen::Matrix3d matrix;
  matrix << camera.fx, 0.0, camera.cx + pixel_center, 0.0, camera.fy, camera.cy + pixel_center, 0.0,
      0.0, 1.0;
  return TensorOf(matrix);
}

o3c::Tensor Extrinsics(const Rigid3& cam_from_world) {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = cam_from_world.rotation().toRotationMatrix();
  matrix.topRightCorner<3, 1>() = cam_from_world.translation();
  return TensorOf(matrix);
}

// Copies.
template <typename Scalar>
o3g::Image ImageOf(const cv::Mat& image) {
  const cv::Mat pixels = image.isContinuous() ? image : image.clone();
  return o3g::Image(o3c::Tensor(reinterpret_cast<const Scalar*>(pixels.data),
                                {pixels.rows, pixels.cols, pixels.channels()},
                                o3c::Dtype::FromType<Scalar>(), kCpu));
}

void CopyVertices(const o3c::Tensor& positions, const o3c::Tensor& colors, ColoredMesh* mesh) {
  const o3c::Tensor xyz = positions.To(o3c::Float32).Contiguous();
  const o3c::Tensor rgb = colors.To(o3c::Float32).Contiguous();
  const float* x = xyz.GetDataPtr<float>();
  const float* c = rgb.GetDataPtr<float>();
  for (int64_t i = 0; i < xyz.GetLength(); ++i, x += 3, c += 3) {
    mesh->positions.emplace_back(x[0], x[1], x[2]);
    std::array<uint8_t, 3> color;
    for (int k = 0; k < 3; ++k) color[k] = cv::saturate_cast<uint8_t>(c[k]);
    mesh->colors.push_back(color);
  }
}

void CopyNormals(const o3c::Tensor& normals, ColoredMesh* mesh) {
  const o3c::Tensor xyz = normals.To(o3c::Float32).Contiguous();
  const float* x = xyz.GetDataPtr<float>();
  for (int64_t i = 0; i < xyz.GetLength(); ++i, x += 3)
    mesh->normals.emplace_back(x[0], x[1], x[2]);
}

void CopyTriangles(const o3c::Tensor& indices, ColoredMesh* mesh) {
  const o3c::Tensor corners = indices.To(o3c::Int32).Contiguous();
  const int32_t* corner = corners.GetDataPtr<int32_t>();
  for (int64_t i = 0; i < corners.GetLength(); ++i, corner += 3) {
    mesh->triangles.push_back({corner[0], corner[1], corner[2]});
  }
}

open3d::geometry::TriangleMesh ToOpen3d(const ColoredMesh& mesh) {
  open3d::geometry::TriangleMesh result;
  for (const Eigen::Vector3f& x : mesh.positions) result.vertices_.push_back(x.cast<double>());
  for (const std::array<uint8_t, 3>& rgb : mesh.colors) {
    result.vertex_colors_.emplace_back(rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0);
  }
  for (const std::array<int32_t, 3>& corners : mesh.triangles) {
    result.triangles_.emplace_back(corners[0], corners[1], corners[2]);
  }
  return result;
}

ColoredMesh FromOpen3d(const open3d::geometry::TriangleMesh& mesh) {
  ColoredMesh result;
  for (const Eigen::Vector3d& x : mesh.vertices_) result.positions.push_back(x.cast<float>());
  for (const Eigen::Vector3d& rgb : mesh.vertex_colors_) {
    std::array<uint8_t, 3> color;
    for (int k = 0; k < 3; ++k) color[k] = cv::saturate_cast<uint8_t>(255.0 * rgb[k]);
    result.colors.push_back(color);
  }
  for (const Eigen::Vector3i& corners : mesh.triangles_) {
    result.triangles.push_back({corners[0], corners[1], corners[2]});
  }
  return result;
}

class Open3dFusion : public SurfaceFusion {
 public:
  explicit Open3dFusion(const SurfaceFusionOptions& options)
      : options_(options),
        touch_intrinsics_(Intrinsics(options.camera, 0.0)),
        integration_intrinsics_(Intrinsics(options.camera, 0.5)),
        grid_({"tsdf", "weight", "color"}, {o3c::Float32, o3c::UInt16, o3c::UInt16},
              {{1}, {1}, {3}}, static_cast<float>(options.voxel_size), kBlockResolution,
              kInitialBlocks, kCpu) {
    open3d::utility::SetVerbosityLevel(open3d::utility::VerbosityLevel::Error);
  }

  void Add(const cv::Mat& depth, const cv::Mat& rgb, const Rigid3& cam_from_world) override {
    const o3g::Image depth_image = ImageOf<float>(depth);
    // Voxels hold 255 times these values, and truncate each running mean: from 0..255, they keep
    // fractions of a grey level.
    cv::Mat color;
    rgb.convertTo(color, CV_32FC3);
    const o3c::Tensor extrinsics = Extrinsics(cam_from_world);
    const float max_depth = static_cast<float>(options_.max_depth);
    const o3c::Tensor blocks = BlocksNear(depth_image, extrinsics);
    if (blocks.NumElements() == 0) return;
    grid_.Integrate(blocks, depth_image, ImageOf<float>(color), integration_intrinsics_, extrinsics,
                    1.0f, max_depth, kTruncation);
    is_empty_ = false;
    CheckMemory();
  }

  ColoredMesh Extract(bool with_triangles) const override {
    ColoredMesh mesh;
    if (is_empty_) return mesh;
    o3g::VoxelBlockGrid grid = grid_;  // shares the voxels; Open3D's extraction is not const
    VacateFirstBlock(grid.GetHashMap());
    // Voxels of a larger weight are used; an observation weighs 1.
    const auto min_weight = static_cast<float>(options_.min_observations - 1);
    if (with_triangles) {
      const o3g::TriangleMesh surface = grid.ExtractTriangleMesh(min_weight);
      CopyVertices(surface.GetVertexPositions(), surface.GetVertexColors(), &mesh);
      CopyTriangles(surface.GetTriangleIndices(), &mesh);
    } else {
      const o3g::PointCloud points = grid.ExtractPointCloud(min_weight);
      CopyVertices(points.GetPointPositions(), points.GetPointColors(), &mesh);
      CopyNormals(points.GetPointNormals(), &mesh);
    }
    return mesh;
  }

  ColoredMesh Simplify(const ColoredMesh& mesh, size_t max_triangles) const override {
    if (mesh.triangles.size() <= max_triangles) return mesh;
    const open3d::geometry::TriangleMesh fine = ToOpen3d(mesh);
    // Marching cubes makes about two triangles per square of a voxel.
    double cell =
        options_.voxel_size * std::sqrt(static_cast<double>(mesh.triangles.size()) / max_triangles);
    while (true) {
      const auto coarse = fine.SimplifyVertexClustering(cell);
      if (coarse->triangles_.size() <= max_triangles) return FromOpen3d(*coarse);
      cell *= kCellGrowth;
    }
  }

 private:
  // The blocks near measured depths; empty if there are none in range, which Open3D takes for an
  // error.
  o3c::Tensor BlocksNear(const o3g::Image& depth, const o3c::Tensor& extrinsics) {
    try {
      return grid_.GetUniqueBlockCoordinates(depth, touch_intrinsics_, extrinsics, 1.0f,
                                             static_cast<float>(options_.max_depth), kTruncation);
    } catch (const std::runtime_error& error) {
      if (std::string(error.what()).find("No block is touched") == std::string::npos) throw;
      return {};
    }
  }

  // Moves the block at index 0 to another index, and an empty one to its place, far from all
  // others. Open3D takes the voxel with index 0 for a missing one when it extracts triangles, and
  // ends the program if the surface passes beside it. Throws std::runtime_error if the table does
  // not give the index that has become free last.
  static void VacateFirstBlock(o3c::HashMap blocks) {
    if (blocks.Size() == blocks.GetCapacity()) blocks.Reserve(blocks.Size() + 1);
    const o3c::Tensor far = o3c::Tensor::Full({1, 3}, kFarBlock, o3c::Int32, kCpu);
    const o3c::Tensor key = blocks.GetKeyTensor().Slice(0, 0, 1).Clone();
    if (key.AllEqual(far)) return;
    std::vector<o3c::Tensor> values;
    for (const o3c::Tensor& all : blocks.GetValueTensors()) {
      values.push_back(all.Slice(0, 0, 1).Clone());
    }
    blocks.Erase(key);
    const auto activate = [&blocks](const o3c::Tensor& block) {
      return blocks.Activate(block).first[0].Item<int32_t>();
    };
    if (activate(far) != 0) throw std::runtime_error("Open3D: the first block cannot be moved");
    const int64_t moved = activate(key);
    for (size_t i = 0; i < values.size(); ++i) {
      o3c::Tensor all = blocks.GetValueTensor(i);
      all.Slice(0, moved, moved + 1).AsRvalue() = values[i];
      all.Slice(0, 0, 1).Fill(0);
    }
  }

  // The table doubles its capacity when it is full, so that its size lags behind its memory.
  void CheckMemory() {
    const double capacity = static_cast<double>(grid_.GetHashMap().GetCapacity());
    const double mib = capacity * std::pow(kBlockResolution, 3) * kBytesPerVoxel / (1 << 20);
    if (mib <= options_.max_memory_mib) return;
    throw std::runtime_error(FormatText(
        "the surface needs more than %.0f MiB of voxels of %g m; choose larger voxels, a smaller "
        "maximum depth, or more memory",
        options_.max_memory_mib, options_.voxel_size));
  }

  SurfaceFusionOptions options_;
  // Open3D finds blocks by back-projecting the indices of pixels, whose centres are integers here,
  // but integrates the pixel whose index is the projection of a voxel, rounded down: its centre is
  // at one half. Both colour and depth are taken from that pixel.
  o3c::Tensor touch_intrinsics_;
  o3c::Tensor integration_intrinsics_;
  o3g::VoxelBlockGrid grid_;
  bool is_empty_ = true;
};

}  // namespace

}  // namespace msc_vo

extern "C" __attribute__((visibility("default"))) msc_vo::SurfaceFusion* msc_vo_make_surface_fusion(
    const msc_vo::SurfaceFusionOptions& options) {
  return new msc_vo::Open3dFusion(options);
}
