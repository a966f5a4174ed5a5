#include "pictures/video/video_encoder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "core/atomic_file.hpp"
#include "pictures/video/av.hpp"

namespace twin::pictures::video {
namespace {

constexpr int kQuality = 20;  // x264's constant rate factor: smaller is better and larger

av::Owner<SwsContext> make_converter(int width, int height) {
  av::Owner<SwsContext> converter(sws_getContext(width, height, AV_PIX_FMT_RGB24, width, height,
                                                 AV_PIX_FMT_YUV420P, SWS_BILINEAR, nullptr, nullptr,
                                                 nullptr));
  if (converter) {
    const int* const table = sws_getCoefficients(SWS_CS_ITU709);
    constexpr int unit = 1 << 16;  // contrast and saturation unchanged
    sws_setColorspaceDetails(converter.get(), sws_getCoefficients(SWS_CS_DEFAULT), 1, table, 0, 0,
                             unit, unit);
  }
  return converter;
}

av::Owner<AVCodecContext> make_codec(int width, int height, int frames_per_second,
                                     bool has_header) {
  const AVCodec* const encoder = avcodec_find_encoder_by_name("libx264");
  if (encoder == nullptr) {
    return nullptr;
  }
  av::Owner<AVCodecContext> codec(avcodec_alloc_context3(encoder));
  codec->width = width;
  codec->height = height;
  codec->pix_fmt = AV_PIX_FMT_YUV420P;
  codec->time_base = {1, frames_per_second};
  codec->framerate = {frames_per_second, 1};
  codec->gop_size = 2 * frames_per_second;  // a player can jump to every second second
  codec->color_range = AVCOL_RANGE_MPEG;
  codec->colorspace = AVCOL_SPC_BT709;
  codec->color_primaries = AVCOL_PRI_BT709;
  codec->color_trc = AVCOL_TRC_BT709;
  codec->flags |= AV_CODEC_FLAG_BITEXACT | (has_header ? AV_CODEC_FLAG_GLOBAL_HEADER : 0);
  av_opt_set(codec->priv_data, "preset", "veryfast", 0);
  av_opt_set_int(codec->priv_data, "crf", kQuality, 0);
  return codec;
}

av::Owner<AVFrame> make_frame(AVPixelFormat format, int width, int height) {
  av::Owner<AVFrame> frame(av_frame_alloc());
  frame->format = format;
  frame->width = width;
  frame->height = height;
  frame->pts = 0;
  return av_frame_get_buffer(frame.get(), 0) < 0 ? nullptr : std::move(frame);
}

/// An error of the temporary file, told of the file that the user knows.
Error about(const std::filesystem::path& output, Error error) {
  constexpr std::string_view kOpen = "cannot open for writing";
  if (error.message.starts_with(kOpen)) {
    error.message.replace(0, kOpen.size(), "cannot write");
  }
  error.file = output.string();
  return error;
}

}  // namespace

struct VideoEncoder::Parts {
  // Locked, so that no other program writes it; FFmpeg opens it a second time, by its name.
  AtomicFile file;
  std::string name;  // of the output, for messages
  av::Owner<AVFormatContext> format;
  av::Owner<AVCodecContext> codec;
  av::Owner<SwsContext> converter;
  av::Owner<AVFrame> rgb;  // RGB, with room behind each row: the converter reads in large steps
  av::Owner<AVFrame> frame;
  av::Owner<AVPacket> packet;
  AVStream* stream = nullptr;  // of format

  explicit Parts(AtomicFile&& locked) : file(std::move(locked)), name(file.target().string()) {}
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;
  ~Parts() {
    if (format && format->pb != nullptr) {
      avio_closep(&format->pb);
    }
  }

  Expected<void> start(int width, int height, int frames_per_second);
  Expected<void> encode(const AVFrame* picture);
};

VideoEncoder::VideoEncoder(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
VideoEncoder::VideoEncoder(VideoEncoder&&) noexcept = default;
VideoEncoder& VideoEncoder::operator=(VideoEncoder&&) noexcept = default;
VideoEncoder::~VideoEncoder() = default;

Expected<VideoEncoder> VideoEncoder::open(const std::filesystem::path& output, int width,
                                          int height, int frames_per_second) {
  if (width < 2 || height < 2 || width % 2 != 0 || height % 2 != 0 || frames_per_second < 1) {
    return fail(
        ErrorCode::kUsage,
        fmt::format("a video of {} x {} pixels at {} frames/s is not possible; use even sizes "
                    "and at least 1 frame/s",
                    width, height, frames_per_second));
  }
  auto file = AtomicFile::create(output, temporary_of(output));
  if (!file) {
    return tl::unexpected(about(output, std::move(file).error()));
  }
  auto parts = std::make_unique<Parts>(*std::move(file));
  if (auto started = parts->start(width, height, frames_per_second); !started) {
    return tl::unexpected(std::move(started.error()));
  }
  return VideoEncoder(std::move(parts));
}

Expected<void> VideoEncoder::Parts::start(int width, int height, int frames_per_second) {
  av_log_set_level(AV_LOG_QUIET);  // what fails comes back as a code
  AVFormatContext* made = nullptr;
  const std::string url =
      "file:" + file.temporary().string();  // a colon in the name is no protocol
  int status = avformat_alloc_output_context2(&made, nullptr, "mp4", url.c_str());
  format.reset(made);
  if (status < 0) {
    return av::error(name, "make an MP4 file", status);
  }
  codec = make_codec(width, height, frames_per_second,
                     (format->oformat->flags & AVFMT_GLOBALHEADER) != 0);
  if (!codec) {
    return fail(ErrorCode::kFile, "FFmpeg's libavcodec has no encoder libx264 for H.264 video");
  }
  if (status = avcodec_open2(codec.get(), codec->codec, nullptr); status < 0) {
    return av::error(name, "start the H.264 encoder", status);
  }
  stream = avformat_new_stream(format.get(), nullptr);
  stream->time_base = codec->time_base;
  stream->avg_frame_rate = codec->framerate;
  avcodec_parameters_from_context(stream->codecpar, codec.get());
  format->flags |= AVFMT_FLAG_BITEXACT;
  if (status = avio_open(&format->pb, url.c_str(), AVIO_FLAG_WRITE); status < 0) {
    return av::error(name, "write", status);
  }
  av_opt_set(format->priv_data, "movflags", "+faststart", 0);
  if (status = avformat_write_header(format.get(), nullptr); status < 0) {
    return av::error(name, "write", status);
  }
  converter = make_converter(width, height);
  packet.reset(av_packet_alloc());
  rgb = make_frame(AV_PIX_FMT_RGB24, width, height);
  frame = make_frame(codec->pix_fmt, width, height);
  return rgb && frame ? Expected<void>{}
                      : Expected<void>(av::error(name, "make a frame", AVERROR(ENOMEM)));
}

Expected<void> VideoEncoder::push(const Image& image) {
  Parts& p = *parts_;
  if (const int status = av_frame_make_writable(p.frame.get()); status < 0) {
    return av::error(p.name, "encode", status);
  }
  for (int y = 0; y < image.height(); ++y) {
    std::copy_n(image.row(y), 3 * image.width(),
                p.rgb->data[0] + static_cast<std::ptrdiff_t>(y) * p.rgb->linesize[0]);
  }
  sws_scale(p.converter.get(), p.rgb->data, p.rgb->linesize, 0, image.height(), p.frame->data,
            p.frame->linesize);
  auto encoded = p.encode(p.frame.get());
  ++p.frame->pts;
  return encoded;
}

/// Hands a frame (or none: the end) to the encoder and writes the packets that are ready.
Expected<void> VideoEncoder::Parts::encode(const AVFrame* picture) {
  int status = avcodec_send_frame(codec.get(), picture);
  while (status >= 0) {
    status = avcodec_receive_packet(codec.get(), packet.get());
    if (status == AVERROR(EAGAIN) || status == AVERROR_EOF) {
      // Written through libavformat's buffer: a full disk shows there first.
      status = format->pb->error;
      break;
    }
    if (status >= 0) {
      packet->duration = 1;
      av_packet_rescale_ts(packet.get(), codec->time_base, stream->time_base);
      packet->stream_index = stream->index;
      status = av_interleaved_write_frame(format.get(), packet.get());
    }
  }
  return status < 0 ? Expected<void>(av::error(name, "write", status)) : Expected<void>{};
}

Expected<void> VideoEncoder::finish() {
  Parts& p = *parts_;
  if (auto flushed = p.encode(nullptr); !flushed) {
    return flushed;
  }
  if (const int status = av_write_trailer(p.format.get()); status < 0) {
    return av::error(p.name, "write", status);
  }
  if (const int status = avio_closep(&p.format->pb); status < 0) {
    return av::error(p.name, "write", status);
  }
  return p.file.commit();
}

}  // namespace twin::pictures::video
