#include <algorithm>
#include <string_view>

#include "core/atomic_file.hpp"
#include "pictures/video/av.hpp"
#include "pictures/video/video_encoder.hpp"

namespace twin::pictures::video {

Expected<void> write_png(const Image& image, const std::filesystem::path& output) {
  const AVCodec* const encoder = avcodec_find_encoder(AV_CODEC_ID_PNG);
  if (encoder == nullptr) {
    return fail(ErrorCode::kFile, "FFmpeg's libavcodec has no PNG encoder");
  }
  const av::Owner<AVCodecContext> codec(avcodec_alloc_context3(encoder));
  const av::Owner<AVFrame> frame(av_frame_alloc());
  const av::Owner<AVPacket> packet(av_packet_alloc());
  codec->width = frame->width = image.width();
  codec->height = frame->height = image.height();
  codec->pix_fmt = AV_PIX_FMT_RGB24;
  frame->format = codec->pix_fmt;
  codec->time_base = {1, 1};
  codec->flags |= AV_CODEC_FLAG_BITEXACT;
  int status = avcodec_open2(codec.get(), encoder, nullptr);
  if (status >= 0) {
    status = av_frame_get_buffer(frame.get(), 0);
  }
  if (status >= 0) {
    for (int y = 0; y < image.height(); ++y) {
      std::copy_n(image.row(y), 3 * image.width(),
                  frame->data[0] + static_cast<std::ptrdiff_t>(y) * frame->linesize[0]);
    }
    status = avcodec_send_frame(codec.get(), frame.get());
  }
  if (status >= 0) {
    status = avcodec_receive_packet(codec.get(), packet.get());
  }
  if (status < 0) {
    return av::error(output.string(), "encode a PNG picture", status);
  }
  return write_whole_file(output, {reinterpret_cast<const char*>(packet->data),
                                   static_cast<std::size_t>(packet->size)});
}

}  // namespace twin::pictures::video
