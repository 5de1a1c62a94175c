// OpenEXR files in memory, written by the OpenEXR library.
#pragma once

#include <ImfChannelList.h>
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineOutputFile.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfStdIO.h>
#include <ImfTiledOutputFile.h>

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace exr_files {

// The value of a channel at a pixel.
using Value = std::function<float(const std::string& channel, int x, int y)>;

// The values of all channels of a part over its data window, as its file will hold them.
class Pixels {
  public:
    Pixels(const Imf::Header& header, const Value& value) {
        const Imath::Box2i window = header.dataWindow();
        const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
        for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
            const Imf::PixelType type = c.channel().type;
            const int step_x = c.channel().xSampling, step_y = c.channel().ySampling;
            std::vector<char>& bytes = values_.emplace_back();
            for (int y = window.min.y; y <= window.max.y; y += step_y) {
                for (int x = window.min.x; x <= window.max.x; x += step_x) append(bytes, type, value(c.name(), x, y));
            }
            const std::size_t size = type == Imf::HALF ? 2 : 4, row = size * (width / static_cast<std::size_t>(step_x));
            char* first = bytes.data() - static_cast<std::ptrdiff_t>(size) * (window.min.x / step_x) -
                          static_cast<std::ptrdiff_t>(row) * (window.min.y / step_y);
            buffer_.insert(c.name(), {type, first, size, row, step_x, step_y});
        }
    }

    [[nodiscard]] const Imf::FrameBuffer& buffer() const { return buffer_; }

  private:
    static void append(std::vector<char>& bytes, Imf::PixelType type, float value) {
        const auto add = [&](auto number) {
            const char* first = reinterpret_cast<const char*>(&number);
            bytes.insert(bytes.end(), first, first + sizeof(number));
        };
        if (type == Imf::HALF) add(half{value});
        if (type == Imf::FLOAT) add(value);
        if (type == Imf::UINT) add(static_cast<unsigned>(value));
    }

    std::vector<std::vector<char>> values_;
    Imf::FrameBuffer buffer_;
};

inline Imf::Header header(int width, int height, const std::vector<std::string>& channels = {"R", "G", "B"},
                          Imf::PixelType type = Imf::FLOAT) {
    Imf::Header result{width, height};
    for (const std::string& name : channels) result.channels().insert(name, Imf::Channel{type});
    return result;
}

inline int height(const Imf::Header& header) {
    return header.dataWindow().max.y - header.dataWindow().min.y + 1;
}

inline std::string scan_lines(const Imf::Header& header, const Value& value) {
    Imf::StdOSStream stream;
    {
        const Pixels pixels{header, value};
        Imf::OutputFile file{stream, header, 0};
        file.setFrameBuffer(pixels.buffer());
        file.writePixels(height(header));
    }
    return stream.str();
}

// All levels get the values of the lowest.
inline std::string tiles(Imf::Header header, const Value& value, Imf::LevelMode mode) {
    header.setTileDescription(Imf::TileDescription{8, 8, mode});
    Imf::StdOSStream stream;
    {
        const Pixels pixels{header, value};
        Imf::TiledOutputFile file{stream, header, 0};
        file.setFrameBuffer(pixels.buffer());
        for (int y = 0; y < file.numYLevels(); ++y) {
            for (int x = 0; x < file.numXLevels(); ++x) {
                if (file.isValidLevel(x, y)) file.writeTiles(0, file.numXTiles(x) - 1, 0, file.numYTiles(y) - 1, x, y);
            }
        }
    }
    return stream.str();
}

// Parts of scan lines, named "part 1", "part 2" ...
inline std::string parts(std::vector<Imf::Header> headers, const Value& value) {
    for (std::size_t i = 0; i < headers.size(); ++i) {
        headers[i].setName("part " + std::to_string(i + 1));
        headers[i].setType(Imf::SCANLINEIMAGE);
    }
    Imf::StdOSStream stream;
    {
        Imf::MultiPartOutputFile file{stream, headers.data(), static_cast<int>(headers.size()), false, 0};
        for (std::size_t i = 0; i < headers.size(); ++i) {
            const Pixels pixels{headers[i], value};
            Imf::OutputPart part{file, static_cast<int>(i)};
            part.setFrameBuffer(pixels.buffer());
            part.writePixels(height(headers[i]));
        }
    }
    return stream.str();
}

// Two pixels without any sample.
inline std::string deep() {
    Imf::Header all = header(2, 1);
    all.setType(Imf::DEEPSCANLINE);
    all.compression() = Imf::ZIPS_COMPRESSION;
    Imf::StdOSStream stream;
    {
        std::vector<unsigned> counts(2);
        std::vector<float*> samples(2);
        Imf::DeepFrameBuffer buffer;
        buffer.insertSampleCountSlice(
            {Imf::UINT, reinterpret_cast<char*>(counts.data()), sizeof(unsigned), 2 * sizeof(unsigned)});
        for (const char* name : {"R", "G", "B"}) {
            buffer.insert(name, {Imf::FLOAT, reinterpret_cast<char*>(samples.data()), sizeof(float*),
                                 2 * sizeof(float*), sizeof(float)});
        }
        Imf::DeepScanLineOutputFile file{stream, all, 0};
        file.setFrameBuffer(buffer);
        file.writePixels(1);
    }
    return stream.str();
}

}  // namespace exr_files
