#include "tools/treeplay/gl.h"

#include <vector>

#include <fmt/format.h>

namespace copse::treeplay {

void free_buffer(GLuint name) {
  glDeleteBuffers(1, &name);
}
void free_vertex_array(GLuint name) {
  glDeleteVertexArrays(1, &name);
}
void free_texture(GLuint name) {
  glDeleteTextures(1, &name);
}
void free_sampler(GLuint name) {
  glDeleteSamplers(1, &name);
}
void free_framebuffer(GLuint name) {
  glDeleteFramebuffers(1, &name);
}
void free_program(GLuint name) {
  glDeleteProgram(name);
}

Buffer make_buffer() {
  GLuint name = 0;
  glGenBuffers(1, &name);
  return Buffer(name);
}
VertexArray make_vertex_array() {
  GLuint name = 0;
  glGenVertexArrays(1, &name);
  return VertexArray(name);
}
Texture2 make_texture() {
  GLuint name = 0;
  glGenTextures(1, &name);
  return Texture2(name);
}
Sampler make_sampler() {
  GLuint name = 0;
  glGenSamplers(1, &name);
  return Sampler(name);
}
Framebuffer make_framebuffer() {
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  return Framebuffer(name);
}

namespace {

// What the driver says about a shader or program, on one line.
template <class Get, class Log>
std::string log_of(GLuint object, Get get, Log log) {
  GLint size = 0;
  get(object, GL_INFO_LOG_LENGTH, &size);
  std::vector<char> text(static_cast<std::size_t>(size) + 1);
  log(object, size, nullptr, text.data());
  return text.data();
}

Result<GLuint> compile(const char* name, GLenum kind, std::string_view common, std::string_view source) {
  const GLuint shader = glCreateShader(kind);
  static constexpr std::string_view k_version =
      "#version 330 core\n#extension GL_ARB_sample_shading : enable\n";
  const GLchar* parts[] = {k_version.data(), common.data(), source.data()};
  const GLint sizes[] = {static_cast<GLint>(k_version.size()), static_cast<GLint>(common.size()),
                         static_cast<GLint>(source.size())};
  glShaderSource(shader, 3, parts, sizes);
  glCompileShader(shader);
  GLint done = 0;
  glGetShaderiv(shader, GL_COMPILE_STATUS, &done);
  if (done) return shader;
  const std::string log = log_of(shader, glGetShaderiv, glGetShaderInfoLog);
  glDeleteShader(shader);
  return fail(Fault::bug, "", fmt::format("the driver cannot compile shader '{}': {}", name, log),
              "report it with the driver's name");
}

}  // namespace

Result<Program> Program::make(const char* name, std::string_view common, std::string_view vertex,
                              std::string_view fragment) {
  const auto vs = compile(name, GL_VERTEX_SHADER, "", vertex);
  if (!vs) return std::unexpected(vs.error());
  const auto fs = compile(name, GL_FRAGMENT_SHADER, common, fragment);
  if (!fs) {
    glDeleteShader(*vs);
    return std::unexpected(fs.error());
  }
  Program program(glCreateProgram());
  const GLuint id = program.program_.get();
  for (const GLuint shader : {*vs, *fs}) glAttachShader(id, shader);
  glLinkProgram(id);
  for (const GLuint shader : {*vs, *fs}) glDeleteShader(shader);  // freed with the program
  GLint done = 0;
  glGetProgramiv(id, GL_LINK_STATUS, &done);
  if (done) return program;
  return fail(Fault::bug, "",
              fmt::format("the driver cannot link shader '{}': {}", name,
                          log_of(id, glGetProgramiv, glGetProgramInfoLog)),
              "report it with the driver's name");
}

void Program::use() const {
  glUseProgram(program_.get());
}
void Program::set(const char* name, int value) const {
  glUniform1i(at(name), value);
}
void Program::set(const char* name, float value) const {
  glUniform1f(at(name), value);
}
void Program::set(const char* name, const Float2& value) const {
  glUniform2f(at(name), value.x, value.y);
}
void Program::set(const char* name, const Float3& value) const {
  glUniform3f(at(name), value.x, value.y, value.z);
}
void Program::set(const char* name, const Float4& value) const {
  glUniform4f(at(name), value.x, value.y, value.z, value.w);
}
void Program::set(const char* name, int x, int y) const {
  glUniform2i(at(name), x, y);
}
void Program::set(const char* name, const Mat4& value) const {
  glUniformMatrix4fv(at(name), 1, GL_FALSE, value.m.data());
}

Result<void> check_gl(const char* doing) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return {};
  if (error == GL_OUT_OF_MEMORY) {
    return refuse("", fmt::format("{}: the graphics driver is out of memory", doing),
                  "draw a smaller picture or with fewer --samples");
  }
  return fail(Fault::bug, "", fmt::format("{}: OpenGL error 0x{:04x}", doing, error),
              "report it with the driver's name");
}

}  // namespace copse::treeplay
