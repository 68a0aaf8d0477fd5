// SPDX-License-Identifier: Apache-2.0
#include "sim/figures/figure_pictures.hpp"

#include <fmt/ranges.h>

#include <pugixml.hpp>
#include <sstream>

#include "reference/visible_pixels.hpp"
#include "scene/builtin_meshes.hpp"
#include "scene/hen_mesh.hpp"
#include "sim/files/flip.hpp"
#include "sim/files/image.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/os/file.hpp"
#include "sim/os/threads.hpp"

namespace halfway::figures {
namespace {

constexpr int c_subpixel_bits = 4;
constexpr std::uint32_t c_hen_cells = 6;  // per unit of length

// Remove gnuplot's many empty groups, and its titles of curves.
void prune(pugi::xml_node node) {
  for (pugi::xml_node child = node.first_child(), next; child; child = next) {
    next = child.next_sibling();
    prune(child);
    const bool is_group = std::string_view(child.name()) == "g";
    if (is_group && std::string_view(child.attribute("id").value()).starts_with("gnuplot_plot_"))
      child.remove_child("title");
    if (is_group && !child.first_child()) node.remove_child(child);
  }
}

// Insert title and description; gnuplot 5.4 has no option for them.
std::string described(const std::string& svg, const Plot& plot) {
  pugi::xml_document document;
  const auto parsed = document.load_string(svg.c_str(), pugi::parse_default | pugi::parse_declaration);
  pugi::xml_node root = document.child("svg"), desc = root.child("desc");
  if (!parsed || !desc) throw_tool_failed("gnuplot's SVG cannot be read: {}", parsed.description());
  std::string produced = desc.text().get();
  produced.erase(produced.find_last_not_of(' ') + 1);
  root.prepend_attribute("role") = "img";
  root.child("title").text() = plot.title.c_str();
  desc.text() = (plot.words.empty() ? plot.title : plot.words).c_str();
  root.insert_child_after(pugi::node_comment, desc).set_value((" " + produced + " ").c_str());
  prune(root);
  std::ostringstream out;
  document.save(out, "", pugi::format_raw);
  // Put each element on a line, without line breaks in texts.
  std::string text = out.str();
  for (const std::string_view next : {"><g", "><path", "><use", "><rect", "><title", "><desc", "><!--"})
    for (std::size_t at = 0; (at = text.find(next, at)) != std::string::npos; at += next.size())
      text.insert(at + 1, "\n");
  return text + '\n';
}

}  // namespace

Scene scene_of(Mesh mesh, const Material& material, const glm::dvec3& to_eye_world) {
  Scene scene;
  scene.name = "figure";
  scene.ambient = glm::dvec3(0.5);
  scene.directional.push_back({glm::normalize(glm::dvec3(-0.5, 0.6, 1.0)), glm::dvec3(1.0)});
  scene.materials = {material};
  scene.positions_world = std::move(mesh.positions);
  scene.normals_world = std::move(mesh.normals);
  scene.triangles = std::move(mesh.triangles);
  for (SceneTriangle& triangle : scene.triangles) triangle.material = 0;
  scene.camera = fit_camera(bounding_sphere(scene), to_eye_world);
  return scene;
}

Scene sphere_scene(std::uint32_t slices, std::uint32_t stacks, double exponent) {
  const Material material{
      .name = "sphere", .colour = {0.85, 0.2, 0.15}, .diffuse = 0.65, .specular = 0.4, .exponent = exponent};
  return scene_of(make_uv_sphere(slices, stacks, 1.0), material, {0.0, 0.0, 1.0});
}

Scene hen_scene() {
  const Material material{
      .name = "hen", .colour = {0.8, 0.6, 0.35}, .diffuse = 0.65, .specular = 0.4, .exponent = 20.0};
  Scene scene = scene_of(make_hen(c_hen_cells), material, {0.45, 0.25, 1.0});
  scene.camera.vertical_fov_degrees *= 0.8;  // the bounding sphere is larger than the mesh
  return scene;
}

Scene teapot_scene(const Context& context) {
  Scene scene = must(load_scene("teapot", context.scenes()));
  scene.background = glm::dvec3(0.0);
  return scene;
}

Software draw_in_software(const Scene& scene, FrameSize size, unsigned threads) {
  Software software;
  software.triangles = Projector(scene, size, {}).project_all();
  const RenderOptions options{.frame = size, .workers = on_threads(threads)};
  software.phong = render_reference(scene, software.triangles, options);
  software.gouraud = render_gouraud(scene, software.triangles, options);
  return software;
}

Hardware draw_in_hardware(const Context& context, const Scene& scene, FrameSize size,
                          const PlanRequest& request, const SetupOptions& options) {
  HardwareKey key = must(plan_scene(scene, request)).key;
  // The option needs the units.
  if (options.processors.normalize) key.processors.normalize = true;
  if (context.quick) {
    FrameDriver driver(scene, size, key, {},
                       {.setup = options, .golden_picture = true, .workers = on_threads(context.threads)});
    must(driver.draw());
    const FrameAssembler& golden = driver.golden_frame();
    return {{golden.frame(), golden.mask(), driver.fragments(), 0, driver.counts()}, key};
  }
  return {draw_in_verilator(scene, size, key, context.folders,
                            {.setup = options, .workers = on_threads(context.threads)}),
          key};
}

Frame draw_mesh(const Scene& scene, FrameSize size, unsigned threads) {
  // pixels: half the width of a line, and the width of its soft edge
  constexpr double c_line = 0.55, c_soft = 0.7;
  const std::vector<ScreenTriangle> triangles = Projector(scene, size, {}).project_all();
  const RenderOptions options{.frame = size, .workers = on_threads(threads)};
  Scene paper = scene;
  paper.background = glm::dvec3(1.0);
  return render_visible(
             paper, triangles, options,
             [&] {
               return [&](std::uint32_t index, std::uint32_t x, std::uint32_t y) {
                 const ScreenTriangle& t = triangles[index];
                 const glm::dvec3 weight = barycentric_at_centre(t, c_subpixel_bits, x, y);
                 double nearest = size.width;
                 for (int i = 0; i < 3; ++i) {
                   const ScreenVertex &a = t.vertex[(i + 1) % 3], &b = t.vertex[(i + 2) % 3];
                   const double edge = std::hypot(b.x - a.x, b.y - a.y);
                   const double height = static_cast<double>(t.twice_area()) / edge;
                   nearest = std::min(nearest, std::ldexp(weight[i] * height, -c_subpixel_bits));
                 }
                 return glm::dvec3(0.15 + 0.85 * std::clamp((nearest - c_line) / c_soft, 0.0, 1.0));
               };
             })
      .frame;
}

Frame sheet(std::span<const Frame> frames, std::uint32_t columns) {
  constexpr std::uint32_t c_gap = 4;
  if (frames.empty()) return {};
  const FrameSize one = frames.front().size;
  const auto count = static_cast<std::uint32_t>(frames.size());
  const std::uint32_t rows = (count + columns - 1) / columns;
  Frame whole({columns * (one.width + c_gap) - c_gap, rows * (one.height + c_gap) - c_gap});
  std::fill(whole.rgb.begin(), whole.rgb.end(), std::uint8_t{255});
  for (std::uint32_t i = 0; i < count; ++i)
    put_tile(whole, frames[i], {i % columns * (one.width + c_gap), i / columns * (one.height + c_gap), one});
  return whole;
}

void save_picture(const Context& context, const std::string& name, const Frame& frame, std::string alt,
                  Drawing& drawing) {
  drawing.pictures.push_back({name + ".png", std::move(alt)});
  must(write_png(context.out / (name + ".png"), frame));
}

FrameDistance distance(const Frame& frame, const Frame& other, std::span<const std::uint8_t> mask) {
  return *frame_distance(frame, other, mask);
}

Measured Likeness::measured() const {
  return {fmt::format("{:.2f} % of the pixels seen to differ; {}", seen_percent, shown(distance)),
          seen_percent};
}

Likeness likeness(const Frame& frame, const Frame& other, std::span<const std::uint8_t> mask) {
  const auto seen = must(perceived_pixels(frame, other));
  Likeness alike{.distance = distance(frame, other, mask)};
  alike.seen_percent = 100.0 * static_cast<double>(seen) / static_cast<double>(alike.distance.pixels);
  return alike;
}

std::string shown(const FrameDistance& d) {
  if (d.max_lsb == 0) return "0/255";
  return fmt::format("{}/255 at most, {:.1f} dB", d.max_lsb, d.psnr_db);
}

std::string data_block(const std::string& name, std::span<const std::vector<double>> rows) {
  std::string text = fmt::format("${} << EOD\n", name);
  for (const std::vector<double>& row : rows) text += fmt::format("{:.6g}\n", fmt::join(row, " "));
  return text + "EOD\n";
}

void draw_plot(const Context& context, const std::string& name, const Plot& plot, Drawing& drawing) {
  const std::string svg = run_gnuplot(plot.script, context.out, name);
  must(write_file(context.out / (name + ".svg"), described(svg, plot)));
  drawing.pictures.push_back({name + ".svg", plot.title});
}

}  // namespace halfway::figures
