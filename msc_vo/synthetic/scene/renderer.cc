// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/synthetic/scene/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

#include "msc_vo/synthetic/scene/quad_raster.h"
#include "msc_vo/synthetic/scene/random.h"
#include "msc_vo/synthetic/scene/specular_surface.h"

namespace msc_vo {

namespace {

using Color = Eigen::Vector3f;

// Contrast between neighbouring pixels (range 0..1).
struct Sampling {
  // Below, one sample at the pixel's centre suffices: two grey values, the noise of a camera.
  float flat_contrast = 2.0f / 255.0f;
  // Above, the error of the mean of four samples, about an eighth of the contrast, would exceed the
  // noise.
  float sharp_contrast = 20.0f / 255.0f;
  int largest_side = 4;  // of the grid of samples at sharp contrasts and borders
};

// The errors of quick images are a few grey values.
constexpr Sampling kQuickSampling = {6.0f / 255.0f, 20.0f / 255.0f, 2};

// A point light prepared for shading.
struct Lamp {
  Eigen::Vector3f position;
  float intensity = 0.0f, squared_reach = 0.0f;
};

// A rectangle prepared for shading.
struct Surface {
  const Texture* texture = nullptr;
  Eigen::Vector3f origin, edge_u, edge_v, normal;
  float width = 0.0f, height = 0.0f;
  const std::vector<Lamp>* lamps = nullptr;  // of its zone
};

// Computes the colours of surface points.
class Shader {
 public:
  Shader(const Scene& scene, const std::vector<QuadView>& views) : scene_(scene), views_(views) {
    for (const PointLight& light : scene.lights) {
      const float reach = static_cast<float>(light.reach);
      lamps_[light.zone].push_back(
          {light.position.cast<float>(), static_cast<float>(light.intensity), reach * reach});
    }
    for (const QuadView& view : views) {
      const Quad& quad = scene.quads[view.quad];
      surfaces_.push_back({&quad.texture, quad.origin.cast<float>(), quad.edge_u.cast<float>(),
                           quad.edge_v.cast<float>(), quad.Normal().cast<float>(),
                           static_cast<float>(quad.edge_u.norm()),
                           static_cast<float>(quad.edge_v.norm()), &lamps_[quad.zone]});
    }
  }

  // Colour of view `index` at a pixel where 1/z is `w`.
  Color Shade(int index, const Eigen::Vector3d& pixel, double w) const {
    const float u = static_cast<float>(views_[index].u_over_z.dot(pixel) / w);
    const float v = static_cast<float>(views_[index].v_over_z.dot(pixel) / w);
    const Surface& surface = surfaces_[index];
    const SurfacePoint point{u * surface.width, v * surface.height, surface.width, surface.height};
    const Eigen::Vector3f x = surface.origin + u * surface.edge_u + v * surface.edge_v;
    return EvaluateTexture(*surface.texture, point) * Brightness(x, surface);
  }

  // Colour of the nearest of `candidates` at a pixel; `background` if none is hit.
  template <typename Indices>
  Color ShadeNearest(const Indices& candidates, const Eigen::Vector3d& pixel,
                     const Color& background) const {
    int nearest = -1;
    double nearest_w = 0.0;
    for (const int index : candidates) {
      const double w = views_[index].inverse_depth.dot(pixel);
      if (w <= nearest_w || !views_[index].Contains(pixel, w)) continue;
      nearest = index;
      nearest_w = w;
    }
    return nearest < 0 ? background : Shade(nearest, pixel, nearest_w);
  }

 private:
  // Ambient light and Lambertian reflection of every lamp of the zone, without cast shadows.
  float Brightness(const Eigen::Vector3f& x, const Surface& surface) const {
    float brightness =
        static_cast<float>(scene_.ambient) * (1.0f + surface.normal.dot(scene_.daylight));
    for (const Lamp& lamp : *surface.lamps) {
      const Eigen::Vector3f to_light = lamp.position - x;
      const float cosine_times_distance = surface.normal.dot(to_light);
      if (cosine_times_distance <= 0.0f) continue;
      const float squared = to_light.squaredNorm();
      brightness += lamp.intensity * cosine_times_distance /
                    (std::sqrt(squared) * (1.0f + squared / lamp.squared_reach));
    }
    return brightness;
  }

  const Scene& scene_;
  const std::vector<QuadView>& views_;
  std::vector<Surface> surfaces_;
  std::map<int, std::vector<Lamp>> lamps_;  // by zone
};

// The distinct views that may be visible in a pixel's square.
class Candidates {
 public:
  void Add(int view) {
    if (view < 0 || count_ == views_.size() || std::find(begin(), end(), view) != end()) return;
    views_[count_++] = view;
  }
  const int* begin() const { return views_.data(); }
  const int* end() const { return views_.data() + count_; }

 private:
  // More views would not change the mean colour of a pixel visibly.
  std::array<int, 32> views_{};
  size_t count_ = 0;
};

// Mean colour of the square of a pixel by `side` x `side` samples.
Color SampleSquare(const Shader& shader, const Candidates& views, int x, int y, int side,
                   const Color& background) {
  Color sum = Color::Zero();
  for (int j = 0; j < side; ++j) {
    for (int i = 0; i < side; ++i) {
      const Eigen::Vector3d pixel(x + (i + 0.5) / side - 0.5, y + (j + 0.5) / side - 0.5, 1.0);
      sum += shader.ShadeNearest(views, pixel, background);
    }
  }
  return sum / static_cast<float>(side * side);
}

std::vector<Color> ShadeCenters(const Shader& shader, const HitBuffer& hits) {
  std::vector<Color> colors(hits.view.size(), Color::Zero());
  for (int y = hits.rows.first; y <= hits.rows.last; ++y) {
    for (int x = 0; x < hits.width; ++x) {
      const size_t i = hits.Index(x, y);
      if (hits.view[i] < 0) continue;
      colors[i] = shader.Shade(hits.view[i], Eigen::Vector3d(x, y, 1.0), hits.inverse_depth[i]);
    }
  }
  return colors;
}

// Colour of a pixel; the number of samples depends on the contrast of its neighbourhood.
Color FilterPixel(const Shader& shader, const HitBuffer& hits, const BorderBuffer& borders,
                  const std::vector<Color>& centers, const Sampling& sampling, int x, int y) {
  const size_t here = hits.Index(x, y);
  Candidates views;
  views.Add(hits.view[here]);
  float contrast = 0.0f;
  for (int j = std::max(y - 1, hits.rows.first); j <= std::min(y + 1, hits.rows.last); ++j) {
    for (int i = std::max(x - 1, 0); i <= std::min(x + 1, hits.width - 1); ++i) {
      const size_t there = hits.Index(i, j);
      if (hits.view[there] != hits.view[here]) views.Add(hits.view[there]);
      contrast = std::max(contrast, (centers[there] - centers[here]).cwiseAbs().maxCoeff());
    }
  }
  const bool has_border = borders.begin(here) != borders.end(here);
  for (const int* view = borders.begin(here); view != borders.end(here); ++view) views.Add(*view);
  if (!has_border && contrast < sampling.flat_contrast) return centers[here];
  const int side = has_border || contrast > sampling.sharp_contrast ? sampling.largest_side : 2;
  return SampleSquare(shader, views, x, y, side, centers[here]);
}

}  // namespace

std::vector<uint8_t> RenderedImage::Gray() const {
  std::vector<uint8_t> gray(rgb.size() / 3);
  for (size_t i = 0; i < gray.size(); ++i) {
    gray[i] = ToGrayValue(0.299f * rgb[3 * i] + 0.587f * rgb[3 * i + 1] + 0.114f * rgb[3 * i + 2]);
  }
  return gray;
}

Renderer::Renderer(Scene scene, const PinholeCamera& camera, RenderQuality quality)
    : scene_(std::move(scene)), camera_(camera), quality_(quality) {
  std::string error;
  if (!camera.IsValid(&error)) throw std::invalid_argument("Renderer: " + error);
  for (const SpecularSurface& surface : scene_.specular) {
    reflections_.emplace_back(MirrorImage(scene_, surface.face), camera, quality);
  }
}

RenderedImage Renderer::Render(const Rigid3& cam_from_world) const {
  RenderedImage image = BlankImage();
  DrawBand(cam_from_world, {0, camera_.height - 1}, &image);
  return image;
}

RenderedImage Renderer::RenderRows(const std::function<Rigid3(int y)>& cam_from_world_of) const {
  RenderedImage image = BlankImage();
  for (int y = 0; y < camera_.height; ++y) DrawBand(cam_from_world_of(y), {y, y}, &image);
  return image;
}

RenderedImage Renderer::BlankImage() const {
  const size_t size = static_cast<size_t>(camera_.width) * camera_.height;
  RenderedImage image;
  image.width = camera_.width;
  image.height = camera_.height;
  image.rgb.resize(3 * size);
  image.depth.resize(size, 0.0f);
  return image;
}

void Renderer::DrawDiffuse(const Rigid3& cam_from_world, const RowBand& band,
                           RenderedImage* image) const {
  // The filter needs the neighbours of a pixel from the same pose.
  const RowBand padded{std::max(band.first - 1, 0), std::min(band.last + 1, camera_.height - 1)};
  const bool is_quick = quality_ == RenderQuality::kQuick;
  const Sampling sampling = is_quick ? kQuickSampling : Sampling();
  std::vector<QuadView> views = ViewQuads(scene_, camera_, cam_from_world, padded);
  if (is_quick) RemoveInvisible(scene_, camera_, cam_from_world, &views);
  const HitBuffer hits = Rasterize(views, padded, camera_.width);
  const BorderBuffer borders(views, hits);
  const Shader shader(scene_, views);
  const std::vector<Color> centers = ShadeCenters(shader, hits);
  for (int y = band.first; y <= band.last; ++y) {
    for (int x = 0; x < camera_.width; ++x) {
      const size_t pixel = static_cast<size_t>(y) * camera_.width + x, hit = hits.Index(x, y);
      const Color color = FilterPixel(shader, hits, borders, centers, sampling, x, y);
      for (int k = 0; k < 3; ++k) image->rgb[3 * pixel + k] = ToGrayValue(255.0f * color[k]);
      if (hits.view[hit] < 0) continue;
      image->depth[pixel] = static_cast<float>(1.0 / hits.inverse_depth[hit]);
    }
  }
}

void Renderer::DrawBand(const Rigid3& cam_from_world, const RowBand& band,
                        RenderedImage* image) const {
  DrawDiffuse(cam_from_world, band, image);
  for (size_t i = 0; i < scene_.specular.size(); ++i) {
    DrawSpecular(i, cam_from_world, band, image);
  }
}

void Renderer::DrawSpecular(size_t index, const Rigid3& cam_from_world, const RowBand& band,
                            RenderedImage* image) const {
  const SpecularSurface& surface = scene_.specular[index];
  Scene face;
  face.quads = {surface.face};
  const std::vector<QuadView> views = ViewQuads(face, camera_, cam_from_world, band);
  if (views.empty()) return;
  std::vector<size_t> visible;  // pixels
  for (int y = band.first; y <= band.last; ++y) {
    for (int x = 0; x < camera_.width; ++x) {
      const Eigen::Vector3d pixel(x, y, 1.0);
      const double w = views[0].inverse_depth.dot(pixel);
      const size_t i = static_cast<size_t>(y) * camera_.width + x;
      const bool is_hidden = image->depth[i] > 0.0f && w * image->depth[i] < 1.0;
      if (w <= 0.0 || !views[0].Contains(pixel, w) || is_hidden) continue;
      visible.push_back(i);
    }
  }
  if (visible.empty()) return;
  RenderedImage reflection = BlankImage();
  const auto row = [&](size_t pixel) { return static_cast<int>(pixel / camera_.width); };
  reflections_[index].DrawBand(cam_from_world, {row(visible.front()), row(visible.back())},
                               &reflection);
  for (const size_t i : visible) {
    const Eigen::Vector3d pixel(static_cast<double>(i % camera_.width), row(i), 1.0);
    for (size_t k = 0; k < 3; ++k) {
      uint8_t& value = image->rgb[3 * i + k];
      value = ToGrayValue(static_cast<float>(surface.reflectance) * reflection.rgb[3 * i + k] +
                          static_cast<float>(surface.transmittance) * value +
                          255.0f * surface.color[static_cast<int>(k)]);
    }
    image->depth[i] = static_cast<float>(1.0 / views[0].inverse_depth.dot(pixel));
  }
}

PinholeCamera KinectCamera(int width, int height) {
  PinholeCamera camera;
  camera.fx = camera.fy = 525.0 * width / 640.0;
  camera.cx = 0.5 * (width - 1);
  camera.cy = 0.5 * (height - 1);
  camera.width = width;
  camera.height = height;
  return camera;
}

uint8_t ToGrayValue(float value) {
  return static_cast<uint8_t>(std::lround(std::clamp(value, 0.0f, 255.0f)));
}

void AddImageNoise(double sigma, uint64_t seed, uint64_t frame, RenderedImage* image) {
  Random random(seed, frame);
  for (size_t i = 0; i < image->rgb.size(); i += 3) {
    const float noise = static_cast<float>(sigma * random.Normal());
    for (size_t k = i; k < i + 3; ++k) image->rgb[k] = ToGrayValue(image->rgb[k] + noise);
  }
}

}  // namespace msc_vo
