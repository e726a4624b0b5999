#include "abut/contact/admission.hpp"

namespace abut::contact {

template <int Dim>
bool Admission<Dim>::is_pressed_in(const ContactPair<Dim>& pair, const Vector<Dim>& u_1, const Vector<Dim>& u_2) const {
    const auto at = list_.position(surface_, pair, u_1, u_2);
    return at.gap < 0.0 && list_.overlap(pair, at.tangential_offset, area_).area > 0.0;
}

template <int Dim>
FirstAdmission Admission<Dim>::decide_first(const ContactPair<Dim>& pair, std::span<const Vector<Dim>> u,
                                            bool run_begins) const {
    const Vector<Dim>&u_1 = u[pair.face_1], &u_2 = u[pair.face_2];
    const bool is_shallow = list_.position(surface_, pair, u_1, u_2).gap > -pair.admission_depth;
    return first_admission(is_shallow, is_pressed_in(pair, u_1, u_2), run_begins);
}

template <int Dim>
std::int64_t Admission<Dim>::update(std::span<PairMemory> memory, std::span<const Vector<Dim>> u) const {
    std::int64_t inadmissible_overlaps = 0;
    for (std::int32_t p = 0; p < list_.size(); ++p) {
        const ContactPair<Dim>& pair = list_[p];
        bool& admitted = memory[static_cast<std::size_t>(p)].admitted;
        const auto at = list_.position(surface_, pair, u[pair.listed_1], u[pair.listed_2]);
        const bool wanted = at.gap > -pair.admission_depth;
        if (wanted == admitted && wanted) continue;
        if (at.gap >= 0.0 || list_.stay_apart(pair, at.tangential_offset, at.tangential_offset) ||
            list_.overlap(pair, at.tangential_offset, area_).area == 0.0)
            admitted = wanted;
        else if (!admitted)
            ++inadmissible_overlaps;
    }
    return inadmissible_overlaps;
}

template class Admission<2>;
template class Admission<3>;

}  // namespace abut::contact
