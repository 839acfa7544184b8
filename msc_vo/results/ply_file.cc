// SPDX-License-Identifier: BSD-3-Clause
// SPDX-FileCopyrightText: 2026 the msc_vo authors

#include "msc_vo/results/ply_file.h"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "msc_vo/text/format_text.h"
#include "msc_vo/text/text_file.h"

namespace msc_vo {

namespace {

std::string FormatVertex(const Eigen::Vector3d& x) {
  return FormatText("%.6f %.6f %.6f", x.x(), x.y(), x.z());
}

constexpr const char* kAxisColors[] = {"255 0 0", "0 255 0", "0 0 255"};

// Colours of Fig. 1 of the paper, see FormatLinesPly.
const char* PlyLineColor(const MapLine& line) {
  if (!line.in_last_window) return "0 0 0";
  return line.axis ? kAxisColors[*line.axis] : "128 0 128";
}

const char* PlyPlaneColor(const MapPlane& plane) {
  return plane.axis ? kAxisColors[*plane.axis] : "128 128 128";
}

// An element of a PLY file: a table with named columns.
struct PlyElement {
  std::string name;
  TextLine declaration;
  size_t num_rows = 0;
  bool is_list = false;  // its only property: the row has its length, then as many numbers
  std::vector<std::string> columns;
  std::vector<TextLine> lines;  // lines of the file that contain the rows
  std::vector<std::vector<double>> rows;

  size_t Column(const std::string& column) const {
    for (size_t i = 0; i < columns.size(); ++i) {
      if (columns[i] == column) return i;
    }
    throw std::runtime_error(declaration.Where() + ": element '" + name + "' has no property '" +
                             column + "'; was the file written by msc_vo?");
  }
};

[[noreturn]] void Fail(const TextLine& line, const std::string& expected) {
  throw std::runtime_error(line.Where() + ": expected " + expected + ", found '" +
                           Joined(line.fields, " ") + "'");
}

// Whether the value is a whole number that fits an int.
bool IsCount(double value) { return value >= 0.0 && value <= 1e9 && value == std::floor(value); }

// Returns the elements that the header declares, without rows. `*next`: first line after it.
std::vector<PlyElement> ReadHeader(const std::vector<TextLine>& lines, size_t* next) {
  using Fields = std::vector<std::string>;
  if (lines[0].fields != Fields{"ply"}) Fail(lines[0], "'ply', with which a PLY file begins");
  if (lines.size() < 2 || lines[1].fields != Fields{"format", "ascii", "1.0"}) {
    Fail(lines[lines.size() < 2 ? 0 : 1], "'format ascii 1.0' as the second line");
  }
  std::vector<PlyElement> elements;
  for (*next = 2; *next < lines.size(); ++*next) {
    const TextLine& line = lines[*next];
    const Fields& fields = line.fields;
    if (fields[0] == "comment") continue;
    if (fields[0] == "end_header") {
      ++*next;
      return elements;
    }
    if (fields[0] == "element" && fields.size() == 3) {
      const std::optional<double> count = ParseNumber(fields[2]);
      if (!count || !IsCount(*count)) Fail(line, "a whole number of rows");
      elements.push_back({fields[1], line, static_cast<size_t>(*count), false, {}, {}, {}});
    } else if (fields[0] == "property" && fields.size() == 3 && !elements.empty() &&
               !elements.back().is_list) {
      elements.back().columns.push_back(fields[2]);
    } else if (fields[0] == "property" && fields.size() == 5 && fields[1] == "list" &&
               fields[4] == "vertex_indices" && !elements.empty() &&
               elements.back().columns.empty() && !elements.back().is_list) {
      elements.back().is_list = true;
    } else {
      Fail(line, "'comment', 'element NAME COUNT', 'property TYPE NAME' or 'end_header'");
    }
  }
  throw std::runtime_error(lines.back().Where() + ": the file ends before 'end_header'");
}

std::vector<PlyElement> ReadPly(const std::string& path) {
  const std::vector<TextLine> lines = ReadTextLines(path);
  if (lines.empty()) throw std::runtime_error(path + ":1: the file is empty, expected a PLY file");
  size_t next = 0;
  std::vector<PlyElement> elements = ReadHeader(lines, &next);
  for (PlyElement& element : elements) {
    for (size_t row = 0; row < element.num_rows; ++row, ++next) {
      if (next >= lines.size()) {
        throw std::runtime_error(lines.back().Where() + ": the file ends after " +
                                 std::to_string(row) + " of " + std::to_string(element.num_rows) +
                                 " rows of element '" + element.name + "'; is it complete?");
      }
      element.rows.push_back(ParseNumbers(lines[next]));
      element.lines.push_back(lines[next]);
      const std::vector<double>& numbers = element.rows.back();
      if (element.is_list) {
        if (numbers[0] != static_cast<double>(numbers.size() - 1)) {
          Fail(lines[next], "the number of vertices, then as many indices");
        }
      } else if (numbers.size() != element.columns.size()) {
        Fail(lines[next], std::to_string(element.columns.size()) +
                              " numbers, one per property of '" + element.name + "'");
      }
    }
  }
  if (next < lines.size()) Fail(lines[next], "the end of the file: the header has no more rows");
  return elements;
}

const PlyElement& FindElement(const std::vector<PlyElement>& elements, const char* name,
                              const std::string& path) {
  for (const PlyElement& element : elements) {
    if (element.name == name) return element;
  }
  throw std::runtime_error(path + ": has no element '" + name +
                           "'; was the file written by msc_vo?");
}

// The vectors in three columns of the vertices.
std::vector<Eigen::Vector3d> ReadVectors(const PlyElement& vertices, const std::string& x,
                                         const std::string& y, const std::string& z) {
  const size_t columns[] = {vertices.Column(x), vertices.Column(y), vertices.Column(z)};
  std::vector<Eigen::Vector3d> vectors;
  for (const std::vector<double>& row : vertices.rows) {
    vectors.push_back({row[columns[0]], row[columns[1]], row[columns[2]]});
  }
  return vectors;
}

bool IsIndex(double value, size_t size) {
  return IsCount(value) && value < static_cast<double>(size);
}

// The colour of vertex `i`.
std::array<uint8_t, 3> ColorOf(const PlyElement& vertices,
                               const std::vector<Eigen::Vector3d>& colors, size_t i) {
  std::array<uint8_t, 3> color = {};
  for (size_t k = 0; k < 3; ++k) {
    const double channel = colors[i][static_cast<Eigen::Index>(k)];
    if (!IsCount(channel) || channel > 255.0) {
      Fail(vertices.lines[i], "a colour of three numbers from 0 to 255");
    }
    color[k] = static_cast<uint8_t>(channel);
  }
  return color;
}

// Indices of the two vertices of an edge.
struct EdgeEnds {
  size_t start = 0;
  size_t end = 0;
};

std::vector<EdgeEnds> ReadEdgeEnds(const PlyElement& edges,
                                   const std::vector<Eigen::Vector3d>& positions) {
  const size_t columns[] = {edges.Column("vertex1"), edges.Column("vertex2")};
  std::vector<EdgeEnds> ends;
  for (size_t i = 0; i < edges.rows.size(); ++i) {
    for (const size_t column : columns) {
      if (!IsIndex(edges.rows[i][column], positions.size())) {
        Fail(edges.lines[i],
             "two of the " + std::to_string(positions.size()) + " vertices, counted from 0");
      }
    }
    ends.push_back({static_cast<size_t>(edges.rows[i][columns[0]]),
                    static_cast<size_t>(edges.rows[i][columns[1]])});
    if (positions[ends[i].start] == positions[ends[i].end]) {
      Fail(edges.lines[i], "an edge between two different positions");
    }
  }
  return ends;
}

}  // namespace

std::string FormatPointsPly(const std::vector<MapPoint>& points) {
  std::string text = FormatText(
      "ply\nformat ascii 1.0\ncomment msc_vo map points, metres\nelement vertex %zu\n"
      "property float x\nproperty float y\nproperty float z\nproperty int observations\n"
      "end_header\n",
      points.size());
  for (const MapPoint& point : points) {
    text += FormatVertex(point.position) + FormatText(" %d\n", point.num_observations);
  }
  return text;
}

std::string FormatLinesPly(const std::vector<MapLine>& lines) {
  std::string text = FormatText(
      "ply\nformat ascii 1.0\ncomment msc_vo map lines, metres; normals point to the cameras\n"
      "element vertex %zu\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
      "property int observations\n"
      "element edge %zu\nproperty int vertex1\nproperty int vertex2\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n",
      2 * lines.size(), lines.size());
  for (const MapLine& line : lines) {
    const std::string rest = " " + FormatVertex(Eigen::Vector3d::Zero() - line.viewing_direction) +
                             FormatText(" %s %d\n", PlyLineColor(line), line.num_observations);
    text += FormatVertex(line.segment.start) + rest;
    text += FormatVertex(line.segment.end) + rest;
  }
  for (size_t i = 0; i < lines.size(); ++i) {
    text += FormatText("%zu %zu %s\n", 2 * i, 2 * i + 1, PlyLineColor(lines[i]));
  }
  return text;
}

std::string FormatPlanesPly(const std::vector<MapPlane>& planes) {
  size_t num_vertices = 0, num_faces = 0;
  std::string vertices, faces;
  for (const MapPlane& plane : planes) {
    if (plane.extent.empty()) continue;
    ++num_faces;
    faces += FormatText("%zu", plane.extent.size());
    for (const Eigen::Vector3d& vertex : plane.extent) {
      vertices += FormatVertex(vertex) + " " + FormatVertex(plane.plane.normal()) +
                  FormatText(" %s %d\n", PlyPlaneColor(plane), plane.num_observations);
      faces += FormatText(" %zu", num_vertices++);
    }
    faces += "\n";
  }
  return FormatText(
             "ply\nformat ascii 1.0\ncomment msc_vo map planes, metres; normals point to the "
             "cameras\n"
             "element vertex %zu\nproperty float x\nproperty float y\nproperty float z\n"
             "property float nx\nproperty float ny\nproperty float nz\n"
             "property uchar red\nproperty uchar green\nproperty uchar blue\n"
             "property int observations\n"
             "element face %zu\nproperty list uchar int vertex_indices\nend_header\n",
             num_vertices, num_faces) +
         vertices + faces;
}

std::string FormatEdgesPly(const std::vector<LineSegment3>& edges) {
  std::string text = FormatText(
      "ply\nformat ascii 1.0\ncomment msc_vo edges of a scene, metres\n"
      "element vertex %zu\nproperty float x\nproperty float y\nproperty float z\n"
      "element edge %zu\nproperty int vertex1\nproperty int vertex2\nend_header\n",
      2 * edges.size(), edges.size());
  for (const LineSegment3& edge : edges) {
    text += FormatVertex(edge.start) + "\n" + FormatVertex(edge.end) + "\n";
  }
  for (size_t i = 0; i < edges.size(); ++i) text += FormatText("%zu %zu\n", 2 * i, 2 * i + 1);
  return text;
}

std::vector<EstimatedLine> ReadLinesPly(const std::string& path) {
  const std::vector<PlyElement> elements = ReadPly(path);
  const PlyElement& vertices = FindElement(elements, "vertex", path);
  const std::vector<Eigen::Vector3d> positions = ReadVectors(vertices, "x", "y", "z");
  const std::vector<Eigen::Vector3d> normals = ReadVectors(vertices, "nx", "ny", "nz");
  const size_t observations = vertices.Column("observations");
  std::vector<EstimatedLine> lines;
  for (const EdgeEnds& ends : ReadEdgeEnds(FindElement(elements, "edge", path), positions)) {
    const double num_observations = vertices.rows[ends.start][observations];
    if (!IsCount(num_observations)) {
      Fail(vertices.lines[ends.start], "a whole number of observations");
    }
    lines.push_back({{positions[ends.start], positions[ends.end]},
                     static_cast<int>(num_observations),
                     -normals[ends.start]});
  }
  return lines;
}

std::vector<LineSegment3> ReadEdgesPly(const std::string& path) {
  const std::vector<PlyElement> elements = ReadPly(path);
  const std::vector<Eigen::Vector3d> positions =
      ReadVectors(FindElement(elements, "vertex", path), "x", "y", "z");
  std::vector<LineSegment3> edges;
  for (const EdgeEnds& ends : ReadEdgeEnds(FindElement(elements, "edge", path), positions)) {
    edges.push_back({positions[ends.start], positions[ends.end]});
  }
  return edges;
}

std::vector<MapPoint> ReadPointsPly(const std::string& path) {
  const std::vector<PlyElement> elements = ReadPly(path);
  const PlyElement& vertices = FindElement(elements, "vertex", path);
  const size_t observations = vertices.Column("observations");
  const std::vector<Eigen::Vector3d> positions = ReadVectors(vertices, "x", "y", "z");
  std::vector<MapPoint> points;
  for (size_t i = 0; i < positions.size(); ++i) {
    const double num_observations = vertices.rows[i][observations];
    if (!IsCount(num_observations)) Fail(vertices.lines[i], "a whole number of observations");
    points.push_back({positions[i], static_cast<int>(num_observations)});
  }
  return points;
}

std::vector<ColoredEdge> ReadColoredEdgesPly(const std::string& path) {
  const std::vector<PlyElement> elements = ReadPly(path);
  const PlyElement& vertices = FindElement(elements, "vertex", path);
  const std::vector<Eigen::Vector3d> positions = ReadVectors(vertices, "x", "y", "z");
  const std::vector<Eigen::Vector3d> colors = ReadVectors(vertices, "red", "green", "blue");
  std::vector<ColoredEdge> edges;
  for (const EdgeEnds& ends : ReadEdgeEnds(FindElement(elements, "edge", path), positions)) {
    edges.push_back(
        {{positions[ends.start], positions[ends.end]}, ColorOf(vertices, colors, ends.start)});
  }
  return edges;
}

std::vector<ColoredPolygon> ReadColoredPolygonsPly(const std::string& path) {
  const std::vector<PlyElement> elements = ReadPly(path);
  const PlyElement& vertices = FindElement(elements, "vertex", path);
  const std::vector<Eigen::Vector3d> positions = ReadVectors(vertices, "x", "y", "z");
  const std::vector<Eigen::Vector3d> colors = ReadVectors(vertices, "red", "green", "blue");
  const PlyElement& faces = FindElement(elements, "face", path);
  std::vector<ColoredPolygon> polygons;
  for (size_t i = 0; i < faces.rows.size(); ++i) {
    const std::vector<double>& row = faces.rows[i];
    if (!faces.is_list || row.size() < 4) Fail(faces.lines[i], "three or more vertices of a face");
    ColoredPolygon polygon;
    for (size_t k = 1; k < row.size(); ++k) {
      if (!IsIndex(row[k], positions.size())) {
        Fail(faces.lines[i],
             "indices of the " + std::to_string(positions.size()) + " vertices, counted from 0");
      }
      polygon.vertices.push_back(positions[static_cast<size_t>(row[k])]);
    }
    polygon.color = ColorOf(vertices, colors, static_cast<size_t>(row[1]));
    polygons.push_back(std::move(polygon));
  }
  return polygons;
}

}  // namespace msc_vo
