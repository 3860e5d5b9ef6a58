#include "apps/lidar/point_writer.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace sward::apps {

void PointWriter::add(lidar::ReturnParts parts)
{
    finish();
    writing_ = std::async(std::launch::async, [this, held = std::move(parts)] { write(held); });
}

void PointWriter::finish()
{
    if (writing_.valid())
        writing_.get();
}

void PointWriter::write(const lidar::ReturnParts& parts) const
{
    // Each thread encodes some parts that follow one another.
    const auto encode = [this](std::span<const std::vector<lidar::LidarReturn>> some) {
        std::vector<PointBytes> made;
        for (const std::vector<lidar::LidarReturn>& part : some)
            made.push_back(file_.encode(part));
        return made;
    };
    const std::size_t share = std::max<std::size_t>(1, (parts.size() + threads_ - 1) / threads_);
    std::vector<std::future<std::vector<PointBytes>>> tasks;
    for (std::size_t first = 0; first < parts.size(); first += share)
        tasks.push_back(
            std::async(std::launch::async, encode,
                       std::span(parts).subspan(first, std::min(share, parts.size() - first))));
    for (auto& task : tasks)
        for (const PointBytes& some : task.get())
            file_.add(some);
}

} // namespace sward::apps
