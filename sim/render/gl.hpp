// The OpenGL functions that are used.
#pragma once

#include <GL/glcorearb.h>

#include "sim/render/context.hpp"

// clang-format off
#define RENDER_GL_FUNCTIONS(X)                                                                              \
  X(ActiveTexture, ACTIVETEXTURE) X(AttachShader, ATTACHSHADER) X(BindBuffer, BINDBUFFER)                   \
  X(BindFramebuffer, BINDFRAMEBUFFER) X(BindRenderbuffer, BINDRENDERBUFFER) X(BindTexture, BINDTEXTURE)     \
  X(BindVertexArray, BINDVERTEXARRAY) X(BlendFunc, BLENDFUNC) X(BlitFramebuffer, BLITFRAMEBUFFER)           \
  X(BufferData, BUFFERDATA)                                                                                 \
  X(CheckFramebufferStatus, CHECKFRAMEBUFFERSTATUS) X(Clear, CLEAR) X(ClearColor, CLEARCOLOR)               \
  X(CompileShader, COMPILESHADER) X(CreateProgram, CREATEPROGRAM) X(CreateShader, CREATESHADER)             \
  X(CullFace, CULLFACE) X(DeleteShader, DELETESHADER) X(DepthFunc, DEPTHFUNC) X(Disable, DISABLE)           \
  X(DrawArrays, DRAWARRAYS) X(DrawArraysInstanced, DRAWARRAYSINSTANCED) X(DrawBuffer, DRAWBUFFER)           \
  X(DrawElementsInstanced, DRAWELEMENTSINSTANCED) X(Enable, ENABLE)                                         \
  X(EnableVertexAttribArray, ENABLEVERTEXATTRIBARRAY) X(FramebufferRenderbuffer, FRAMEBUFFERRENDERBUFFER)   \
  X(FramebufferTexture2D, FRAMEBUFFERTEXTURE2D) X(GenBuffers, GENBUFFERS)                                   \
  X(GenFramebuffers, GENFRAMEBUFFERS) X(GenRenderbuffers, GENRENDERBUFFERS) X(GenTextures, GENTEXTURES)     \
  X(GenVertexArrays, GENVERTEXARRAYS) X(GetError, GETERROR) X(GetIntegerv, GETINTEGERV)                     \
  X(GetProgramInfoLog, GETPROGRAMINFOLOG) X(GetProgramiv, GETPROGRAMIV)                                     \
  X(GetShaderInfoLog, GETSHADERINFOLOG) X(GetShaderiv, GETSHADERIV) X(GetString, GETSTRING)                 \
  X(GetUniformLocation, GETUNIFORMLOCATION) X(LinkProgram, LINKPROGRAM) X(PixelStorei, PIXELSTOREI)         \
  X(ReadBuffer, READBUFFER) X(ReadPixels, READPIXELS) X(RenderbufferStorage, RENDERBUFFERSTORAGE)           \
  X(Scissor, SCISSOR) X(ShaderSource, SHADERSOURCE) X(TexImage2D, TEXIMAGE2D)                               \
  X(TexImage2DMultisample, TEXIMAGE2DMULTISAMPLE) X(TexParameteri, TEXPARAMETERI) X(Uniform1f, UNIFORM1F)   \
  X(Uniform1i, UNIFORM1I) X(Uniform2f, UNIFORM2F) X(Uniform3f, UNIFORM3F) X(Uniform4f, UNIFORM4F)           \
  X(UniformMatrix3fv, UNIFORMMATRIX3FV) X(UniformMatrix4fv, UNIFORMMATRIX4FV) X(UseProgram, USEPROGRAM)     \
  X(VertexAttribDivisor, VERTEXATTRIBDIVISOR) X(VertexAttribPointer, VERTEXATTRIBPOINTER)                   \
  X(Viewport, VIEWPORT)
// clang-format on

namespace render {

/// `gl.Clear(...)` is glClear(...) of the current context.
struct Gl {
  /// Throws std::runtime_error with the name of a function that is missing.
  explicit Gl(const Context& context);

  /// Throws std::runtime_error if a call has failed since the last check.
  void check(const char* doing) const;

#define RENDER_GL_FIELD(name, type) PFNGL##type##PROC name;
  RENDER_GL_FUNCTIONS(RENDER_GL_FIELD)
#undef RENDER_GL_FIELD
};

}  // namespace render
