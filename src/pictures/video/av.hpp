#pragma once

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

#include <memory>
#include <string>
#include <string_view>

#include "core/error.hpp"

/// Owners of FFmpeg's structs, and its error codes as text.
namespace twin::pictures::video::av {

struct Free {
  void operator()(AVCodecContext* p) const noexcept { avcodec_free_context(&p); }
  void operator()(AVFormatContext* p) const noexcept { avformat_free_context(p); }
  void operator()(AVFrame* p) const noexcept { av_frame_free(&p); }
  void operator()(AVPacket* p) const noexcept { av_packet_free(&p); }
  void operator()(SwsContext* p) const noexcept { sws_freeContext(p); }
};

template <class T>
using Owner = std::unique_ptr<T, Free>;

/// An error about an output file: "cannot ACTION: FFmpeg's text".
inline tl::unexpected<Error> error(std::string_view file, std::string_view action, int code) {
  char text[AV_ERROR_MAX_STRING_SIZE] = {};
  av_strerror(code, text, sizeof text);
  std::string message = "cannot ";
  message.append(action).append(": ").append(text);
  return tl::unexpected<Error>(
      Error{ErrorCode::kFile, std::move(message), std::string(file), 0, 0});
}

}  // namespace twin::pictures::video::av
