// OpenGL objects that free themselves. Everything here needs a current context of GL 3.3 core or newer.
#pragma once

#include "lib/formats/result.h"
#include "lib/runtime/matrix.h"

#include <string>
#include <string_view>
#include <utility>

#include <epoxy/gl.h>

namespace copse::treeplay {

// An object's name, freed by `Free` when it goes out of scope.
template <void (*Free)(GLuint)>
class Handle {
 public:
  Handle() = default;
  explicit Handle(GLuint name) : name_(name) {}
  Handle(Handle&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(name_, other.name_);
    return *this;
  }
  ~Handle() {
    if (name_) Free(name_);
  }
  GLuint get() const { return name_; }
  explicit operator bool() const { return name_ != 0; }

 private:
  GLuint name_ = 0;
};

void free_buffer(GLuint name);
void free_vertex_array(GLuint name);
void free_texture(GLuint name);
void free_sampler(GLuint name);
void free_framebuffer(GLuint name);
void free_program(GLuint name);

using Buffer = Handle<free_buffer>;
using VertexArray = Handle<free_vertex_array>;
using Texture2 = Handle<free_texture>;
using Sampler = Handle<free_sampler>;
using Framebuffer = Handle<free_framebuffer>;

Buffer make_buffer();
VertexArray make_vertex_array();
Texture2 make_texture();
Sampler make_sampler();
Framebuffer make_framebuffer();

// A linked pair of shaders. Uniforms are set by name; a name that the compiler has dropped is ignored.
class Program {
 public:
  Program() = default;
  // `common` is put in front of the fragment shader, after the #version line.
  static Result<Program> make(const char* name, std::string_view common, std::string_view vertex,
                              std::string_view fragment);
  void use() const;
  void set(const char* name, int value) const;
  void set(const char* name, float value) const;
  void set(const char* name, const Float2& value) const;
  void set(const char* name, const Float3& value) const;
  void set(const char* name, const Float4& value) const;
  void set(const char* name, const Mat4& value) const;
  void set(const char* name, int x, int y) const;

 private:
  explicit Program(GLuint name) : program_(name) {}
  GLint at(const char* name) const { return glGetUniformLocation(program_.get(), name); }
  Handle<free_program> program_;
};

// The first pending GL error as an Error, or nothing: after uploads and draws that may run out of memory.
Result<void> check_gl(const char* doing);

}  // namespace copse::treeplay
