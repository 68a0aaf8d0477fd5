// SPDX-License-Identifier: Apache-2.0
// Draws a scene by OpenGL ES with per-pixel illumination in a fragment shader. `make bench` and `make study`
// run it on Mesa's llvmpipe, which needs no graphics card.
//   halfway_mesa SCENE WIDTHxHEIGHT REPETITIONS FRAME [TESSELLATION [EXPONENT]]
// Writes the frame: red, green and blue of each pixel, line by line from the top left. A drawing starts with
// the vertices in OpenGL's memory and ends with the picture in the program's memory, four bytes per pixel.
// Prints the processor seconds of the fastest drawing, the elapsed seconds of all, and on a second line the
// renderer's name.
#define EGL_EGLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GLES3/gl3.h>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "frame/frame.hpp"
#include "projection/project.hpp"
#include "scene/camera.hpp"
#include "scene/lights.hpp"
#include "scene/mesh.hpp"
#include "shading/shade.hpp"
#include "sim/engines/mesa/mesa_picture.hpp"
#include "sim/files/load_scene.hpp"
#include "sim/os/file.hpp"
#include "sim/os/must.hpp"
#include "sim/os/seconds.hpp"

namespace halfway {
namespace {

constexpr const char* c_vertex_shader = R"(#version 300 es
uniform highp vec3 right, up, backward;
uniform highp vec4 projection;  // of x, y, z, and z's constant
layout(location = 0) in highp vec3 at;  // from the eye, because float has few digits
layout(location = 1) in highp vec3 normal_at;
out highp vec3 position, normal;
void main() {
  position = at;
  normal = normal_at;
  vec3 view = vec3(dot(at, right), dot(at, up), dot(at, backward));
  gl_Position = vec4(projection.x * view.x, projection.y * view.y, projection.z * view.z + projection.w, -view.z);
}
)";

// Same as radiance() of shading/shade.cpp with Blinn's highlights. LIGHTS is inserted before it.
constexpr const char* c_fragment_shader = R"(
precision highp float;
uniform vec3 ambient, diffuse, specular;
uniform float exponent;
uniform vec4 light[LIGHTS];  // a direction, or with w = 1 a place from the eye
uniform vec3 intensity[LIGHTS];
in vec3 position, normal;
out vec4 colour;
void main() {
  vec3 n = normalize(normal), v = normalize(-position), sum = ambient;
  for (int i = 0; i < LIGHTS; ++i) {
    vec3 l = normalize(light[i].xyz - light[i].w * position);
    float n_dot_l = dot(n, l);
    if (n_dot_l > 0.0) {
      float n_dot_h = dot(n, normalize(l + v));
      sum += intensity[i] * (n_dot_l * diffuse + (n_dot_h > 0.0 ? pow(n_dot_h, exponent) : 0.0) * specular);
    }
  }
  colour = vec4(sum, 1.0);
}
)";

[[noreturn]] void fail(const std::string& what) {
  throw_tool_failed("{}", what);
}

/// Create a context without a window. It stays current until the process ends.
void make_context() {
  const EGLDisplay display =
      eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr))
    fail("EGL: no display without a surface; install it with: apt-get install libgl1-mesa-dri");
  const EGLint version[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_NONE};
  eglBindAPI(EGL_OPENGL_ES_API);
  const EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, version);
  if (context == EGL_NO_CONTEXT || !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context))
    fail("EGL: no context of OpenGL ES 3");
}

GLuint make_shader(GLenum kind, const std::string& text) {
  const GLuint shader = glCreateShader(kind);
  const char* source = text.c_str();
  glShaderSource(shader, 1, &source, nullptr);
  glCompileShader(shader);
  GLint compiled = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled) return shader;
  char log[1024];
  glGetShaderInfoLog(shader, sizeof log, nullptr, log);
  fail(fmt::format("OpenGL: {}", log));
}

class Picture {
 public:
  Picture(const Scene& scene, FrameSize size) : scene_(&scene), size_(size) {
    must(mesa_draws(scene));
    std::size_t lights = 0;
    for_each_light(scene, [&](const Light&) { ++lights; });
    program_ = glCreateProgram();
    glAttachShader(program_, make_shader(GL_VERTEX_SHADER, c_vertex_shader));
    glAttachShader(program_, make_shader(GL_FRAGMENT_SHADER,
                                         fmt::format("#version 300 es\n#define LIGHTS {}\n{}",
                                                     std::max<std::size_t>(lights, 1), c_fragment_shader)));
    glLinkProgram(program_);
    GLint linked = 0;
    glGetProgramiv(program_, GL_LINK_STATUS, &linked);
    if (!linked) fail("OpenGL: the shaders do not link");
    glUseProgram(program_);
    set_camera();
    set_lights();
    load_triangles();
    make_frame();
  }

  void draw() const {
    const glm::vec3 background(scene_->background);
    glClearColor(background.r, background.g, background.b, 1.0F);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    for (const Part& part : parts_) {
      const Material& m = scene_->materials[part.material];
      set("ambient", ambient_radiance(*scene_, m));
      set("diffuse", m.diffuse * m.colour);
      set("specular", m.specular * m.specular_colour);
      glUniform1f(glGetUniformLocation(program_, "exponent"), static_cast<float>(m.exponent));
      glDrawElements(GL_TRIANGLES, part.count, GL_UNSIGNED_INT,
                     reinterpret_cast<const void*>(part.first * sizeof(std::uint32_t)));
    }
    glFinish();
  }

  /// Copy the picture from OpenGL's memory: red, green, blue and alpha of each pixel, from the bottom left.
  void read(std::vector<std::uint8_t>& rgba) const {
    glReadPixels(0, 0, static_cast<GLsizei>(size_.width), static_cast<GLsizei>(size_.height), GL_RGBA,
                 GL_UNSIGNED_BYTE, rgba.data());
  }

 private:
  struct Part {
    std::uint32_t material;
    GLsizei count;
    std::size_t first;
  };

  void set(const char* name, glm::dvec3 v) const {
    glUniform3f(glGetUniformLocation(program_, name), static_cast<float>(v.x), static_cast<float>(v.y),
                static_cast<float>(v.z));
  }

  void set_camera() const {
    const Camera& camera = scene_->camera;
    const ViewBasis basis = view_basis(camera);
    const DepthRange range = Projector(*scene_, size_, {}).range();
    set("right", basis.right_world);
    set("up", basis.up_world);
    set("backward", basis.backward_world);
    const double focal = 1.0 / std::tan(0.5 * glm::radians(camera.vertical_fov_degrees));
    const double depth = range.far - range.near;
    glUniform4f(glGetUniformLocation(program_, "projection"),
                static_cast<float>(focal * size_.height / size_.width), static_cast<float>(focal),
                static_cast<float>(-(range.far + range.near) / depth),
                static_cast<float>(-2.0 * range.far * range.near / depth));
  }

  void set_lights() const {
    int i = 0;
    for_each_light(*scene_, [&](const Light& light) {
      const glm::vec3 from(light.point.xyz_world - light.point.w * scene_->camera.eye_world);
      glUniform4f(glGetUniformLocation(program_, fmt::format("light[{}]", i).c_str()), from.x, from.y, from.z,
                  static_cast<float>(light.point.w));
      set(fmt::format("intensity[{}]", i++).c_str(), light.intensity);
    });
  }

  void load_triangles() {
    std::vector<glm::vec3> vertices;  // position, normal
    std::map<std::tuple<std::uint32_t, std::uint32_t, bool>, std::uint32_t> known;
    std::vector<std::vector<std::uint32_t>> indices(scene_->materials.size());
    const auto add_corner = [&](const SceneTriangle& triangle, std::size_t i, bool turned) {
      const auto [at, fresh] = known.try_emplace({triangle.position[i], triangle.normal[i], turned},
                                                 static_cast<std::uint32_t>(known.size()));
      if (fresh) {
        vertices.emplace_back(scene_->positions_world[triangle.position[i]] - scene_->camera.eye_world);
        vertices.emplace_back((turned ? -1.0 : 1.0) * scene_->normals_world[triangle.normal[i]]);
      }
      indices[triangle.material].push_back(at->second);
    };
    for (const SceneTriangle& triangle : scene_->triangles) {
      const bool both = triangle.culling == Culling::none;
      const bool turned = both && has_averted_normals(*scene_, triangle);
      for (const std::size_t i : {0, 1, 2}) add_corner(triangle, i, turned);
      // OpenGL culls one of the two sides.
      if (both)
        for (const std::size_t i : {0, 2, 1}) add_corner(triangle, i, !turned);
    }
    std::vector<std::uint32_t> all;
    for (std::uint32_t material = 0; material < indices.size(); ++material) {
      if (indices[material].empty()) continue;
      parts_.push_back({material, static_cast<GLsizei>(indices[material].size()), all.size()});
      all.insert(all.end(), indices[material].begin(), indices[material].end());
    }
    GLuint buffers[2];
    glGenBuffers(2, buffers);
    glBindBuffer(GL_ARRAY_BUFFER, buffers[0]);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(glm::vec3)),
                 vertices.data(), GL_STATIC_DRAW);
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffers[1]);
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(all.size() * sizeof(std::uint32_t)),
                 all.data(), GL_STATIC_DRAW);
    constexpr GLsizei c_stride = 2 * sizeof(glm::vec3);
    glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, c_stride, nullptr);
    glVertexAttribPointer(1, 3, GL_FLOAT, GL_FALSE, c_stride,
                          reinterpret_cast<const void*>(sizeof(glm::vec3)));
    glEnableVertexAttribArray(0);
    glEnableVertexAttribArray(1);
  }

  void make_frame() const {
    const auto width = static_cast<GLsizei>(size_.width), height = static_cast<GLsizei>(size_.height);
    GLuint frame, buffers[2];
    glGenFramebuffers(1, &frame);
    glBindFramebuffer(GL_FRAMEBUFFER, frame);
    glGenRenderbuffers(2, buffers);
    glBindRenderbuffer(GL_RENDERBUFFER, buffers[0]);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, buffers[0]);
    glBindRenderbuffer(GL_RENDERBUFFER, buffers[1]);
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, buffers[1]);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
      fail("OpenGL: the frame cannot be drawn into");
    glViewport(0, 0, width, height);
    glEnable(GL_DEPTH_TEST);
    glEnable(GL_CULL_FACE);
    glDisable(GL_DITHER);
  }

  const Scene* scene_;
  FrameSize size_;
  GLuint program_ = 0;
  std::vector<Part> parts_;
};

Frame to_frame(const std::vector<std::uint8_t>& rgba, FrameSize size) {
  Frame frame(size);
  for (std::uint32_t y = 0; y < size.height; ++y)
    for (std::uint32_t x = 0; x < size.width; ++x)
      std::copy_n(&rgba[4 * (std::size_t{size.height - 1 - y} * size.width + x)], 3,
                  &frame.rgb[frame.offset(x, y)]);
  return frame;
}

struct Request {
  std::string scene;
  FrameSize size;
  int repetitions = 0;
  std::string file;
  double tessellation = 1.0, exponent = 0.0;  // exponent 0: the scene's
};

void run(const Request& request) {
  Scene scene = must(load_scene(request.scene, std::filesystem::path(HALFWAY_SOURCE_DIR) / "sim/scenes",
                                {.tessellation = request.tessellation}));
  if (request.exponent > 0)
    for (Material& material : scene.materials) material.exponent = request.exponent;
  make_context();
  const Picture picture(scene, request.size);
  std::vector<std::uint8_t> rgba(4 * Frame(request.size).pixels());
  const auto draw = [&] {
    picture.draw();
    picture.read(rgba);
  };
  draw();  // the first drawing compiles the shaders for the processor
  double best = 1e300;
  const auto first = std::chrono::steady_clock::now();
  for (int i = 0; i < request.repetitions; ++i) {
    const double start = process_seconds();
    draw();
    best = std::min(best, process_seconds() - start);
  }
  const double elapsed = seconds_since(first);
  if (const GLenum error = glGetError(); error != GL_NO_ERROR)
    fail(fmt::format("OpenGL: error {:#x}", error));
  fmt::print("{:.9f} {:.9f}\n{}\n", best, elapsed, reinterpret_cast<const char*>(glGetString(GL_RENDERER)));
  const Frame frame = to_frame(rgba, request.size);
  must(write_file(request.file, {reinterpret_cast<const char*>(frame.rgb.data()), frame.rgb.size()}));
}

}  // namespace
}  // namespace halfway

int main(int argc, char** argv) try {
  halfway::Request request;
  halfway::FrameSize& size = request.size;
  if (argc < 5 || argc > 7 || std::sscanf(argv[2], "%ux%u", &size.width, &size.height) != 2 ||
      std::sscanf(argv[3], "%d", &request.repetitions) != 1 || size.width == 0 || size.height == 0 ||
      std::max(size.width, size.height) > halfway::c_max_frame_side || request.repetitions < 1 ||
      (argc > 5 && std::sscanf(argv[5], "%lf", &request.tessellation) != 1) ||
      (argc > 6 && std::sscanf(argv[6], "%lf", &request.exponent) != 1)) {
    fmt::print(stderr,
               "usage: halfway_mesa SCENE WIDTHxHEIGHT REPETITIONS FRAME [TESSELLATION [EXPONENT]]\n");
    return 2;
  }
  request.scene = argv[1];
  request.file = argv[4];
  halfway::run(request);
  return 0;
} catch (const halfway::Failure& failure) {
  fmt::print(stderr, "{}\n", failure.what());
  return static_cast<int>(failure.error.code);
}
