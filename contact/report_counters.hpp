#pragma once
// Private to the layer.

namespace abut::contact {

/// Every counter of a report in a fixed order, for saving and restoring.
template <class Report, class Visit>
void for_each_counter(Report& report, const Visit& visit) {
    visit(report.candidates), visit(report.candidates_max), visit(report.active_pairs), visit(report.active_pairs_max);
    visit(report.events), visit(report.rebuilds), visit(report.missed_contacts), visit(report.inadmissible_overlaps);
    visit(report.compressed_steps), visit(report.compression_max), visit(report.sliding_ratio_max);
    visit(report.slipped_pairs), visit(report.slipped_compression_max);
}

}  // namespace abut::contact
