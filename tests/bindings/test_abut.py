"""Every function of the module, called from Python. Two unit squares one over the other, as in test_abut.c."""
import gc
import math
import threading
import unittest
import warnings

import numpy as np

import abut

REST = np.array([[0, 0], [1, 0], [1, 1], [0, 1], [0.2, 1.1], [1.2, 1.1], [1.2, 2.1], [0.2, 2.1]], dtype=float)
FACES = np.array([[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4]])
BODY = np.repeat([0, 1], 4)
DEPTH = np.full(8, 0.1)


def lowered(by):
    x = REST.copy()
    x[4:, 1] -= by
    return x


def made(**options):
    return abut.NodalContact(REST, FACES, BODY, DEPTH, [3.0, 6.0], **options)


class Contact(unittest.TestCase):
    def test_presses_by_the_spring_in_series(self):
        contact, d, k = made(), 0.05, 2.0
        contact.step(1.0, REST, REST)
        force = np.zeros((8, 2))
        step = contact.step(1.0, REST, lowered(0.1 + d), out=force, mode="end")
        self.assertAlmostEqual(step["energy"], 0.5 * k * d**2 * 0.8, delta=1e-15)
        self.assertAlmostEqual(force[4:, 1].sum(), k * d * 0.8, delta=1e-14)
        np.testing.assert_allclose(force.sum(axis=0), 0.0, atol=1e-15)
        pairs = contact.pairs
        self.assertEqual((len(pairs), pairs["face_1"][0], pairs["face_2"][0]), (1, 2, 4))
        np.testing.assert_allclose(pairs["normal"][0], [0, 1, 0], atol=1e-15)
        self.assertAlmostEqual(pairs["gap_1"][0], -d, delta=1e-15)
        np.testing.assert_allclose(contact.bodies["force"].sum(axis=0), 0.0, atol=1e-15)
        self.assertEqual(contact.body_pairs["active_pairs"][0], 1)
        self.assertEqual(contact.report["missed_contacts"], 0)
        twice = np.zeros((8, 2))
        self.assertAlmostEqual(contact.evaluate(lowered(0.1 + 2 * d), out=twice), 4 * 0.5 * k * d**2 * 0.8, delta=1e-14)
        self.assertAlmostEqual(twice[4:, 1].sum(), 2 * k * d * 0.8, delta=1e-14)

    def test_the_mean_force_is_exact_for_energy(self):
        contact = made()
        contact.step(1.0, REST, REST)
        force, x = np.zeros((8, 2)), lowered(0.17)
        x[4, 1] += 0.02
        step = contact.step(1.0, REST, x, out=force)
        self.assertGreater(step["energy"], 1e-4)
        self.assertAlmostEqual((force * (x - REST)).sum(), step["energy_0"] - step["energy"], delta=1e-16)

    def test_faces_that_overlap_on_purpose_come_to_push_each_other(self):
        d, k, asked = 0.05, 2.0, []
        contact = made(interference_time=1.0, interferes=lambda a, b: asked.append((a, b)) or True)
        x, work = lowered(0.1 + d), 0.0
        for i in range(10):
            step = contact.step(0.1, x, x)
            work += step["interference_work"]
            y = (i + 1) / 10
            self.assertAlmostEqual(step["energy"], 0.5 * k * (d * y * y * (3 - 2 * y))**2 * 0.8, delta=1e-15)
            self.assertAlmostEqual(work, step["energy"], delta=1e-15)
        self.assertIn((2, 4), asked)
        with self.assertRaisesRegex(abut.BadInput, "no `interference_time`"):
            made(interferes=lambda a, b: True)
        self.assertTrue(issubclass(abut.BadInput, ValueError) and issubclass(abut.BadInput, abut.Error))
        with self.assertRaisesRegex(ValueError, "must be finite and > 0"):
            made(interference_time=-1.0)

    def test_any_strides_are_read_and_written_in_place(self):
        packed, x = np.zeros((8, 2)), lowered(0.14)
        plain = made()
        plain.step(1.0, REST, REST)
        plain.step(1.0, REST, x, out=packed)
        for view in (lambda a: np.asfortranarray(a), lambda a: np.repeat(a, 3, axis=0)[::3],
                     lambda a: np.hstack([a, a])[:, :2], lambda a: a[::-1].copy()[::-1]):
            contact, force = made(), view(np.zeros((8, 2)))
            contact.step(1.0, view(REST), view(REST))
            contact.step(1.0, view(REST), view(x), out=force)
            np.testing.assert_array_equal(force, packed)

    def test_state_goes_on_with_the_same_bits(self):
        contact, again = made(), made()
        contact.step(1.0, REST, REST)
        contact.step(1.0, REST, lowered(0.15))
        again.restore(contact.state())
        forces = []
        for one in (contact, again):
            forces.append(np.zeros((8, 2)))
            one.step(1.0, lowered(0.15), lowered(0.16), out=forces[-1])
        np.testing.assert_array_equal(*forces)
        with self.assertRaises(abut.BadInput):
            again.restore(contact.state()[:-1])
        keep = [0, 1, 2, 3, 5, 6, 7]
        contact.surface_replaced(REST, FACES[keep], BODY[keep], DEPTH[keep], [3.0, 6.0], keep)
        self.assertEqual(contact.step(1.0, lowered(0.16), lowered(0.16))["active_pairs"], 0)
        with self.assertRaises(abut.BadInput):
            contact.surface_replaced(REST, FACES[keep], BODY[keep], DEPTH[keep], [3.0, 6.0], [0, 0, 2, 3, 5, 6, 7])

    def test_friction_sticks_by_the_shear_in_series_and_slides_at_its_limit(self):
        s, kappa = 0.003, 2.0 / 3.0
        aside, far = lowered(0.15), lowered(0.15)
        aside[4:, 0] += s
        far[4:, 0] += 0.2
        for mode, force in (("mean", 0.5 * kappa * s), ("end", kappa * s)):
            contact = made(friction=0.5, shear_stiffness=[1.0, 2.0])
            contact.step(0.1, REST, lowered(0.15))
            step = contact.step(0.1, lowered(0.15), aside, mode=mode)
            self.assertAlmostEqual(step["friction_energy"], 0.5 * kappa * s**2, delta=1e-17)
            self.assertEqual((step["sticking_faces"], step["sliding_faces"]), (2, 0))
            np.testing.assert_allclose(contact.pairs["friction"][0], [-force, 0.0, 0.0], atol=1e-15)
            np.testing.assert_allclose(contact.pairs["slip"][0], [s, 0.0, 0.0], atol=1e-15)
            np.testing.assert_array_equal(contact.friction["face"], [2, 4])
            np.testing.assert_allclose(contact.friction["force"], 0.5 * force, atol=1e-15)
            step = contact.step(0.1, aside, far, mode=mode)
            self.assertEqual(step["sliding_faces"], 2)
            self.assertGreater(step["dissipated"], 1e-3)
            self.assertGreaterEqual(contact.report["friction_dissipated"], step["dissipated"])

    def test_laws_of_friction(self):
        shear = dict(shear_stiffness=[1.0, 2.0])

        def limit_over_force(**options):
            contact = made(**shear, **options)
            contact.step(0.1, REST, lowered(0.15))
            faces = contact.friction
            return faces["limit"][0] / faces["normal_force"][0] if len(faces) else 0.0

        several = dict(friction=0.5, laws=[dict(friction=0.25), dict(friction=0.125)])
        for law, mu in ((-1, 0.0), (0, 0.5), (1, 0.25), (2, 0.125)):
            self.assertAlmostEqual(limit_over_force(law_of=lambda a, b: law, **several), mu, delta=1e-14)
        self.assertAlmostEqual(limit_over_force(own_coefficient=lambda speed, slid, pressure: 0.375), 0.375, delta=1e-14)
        for error, text, options in ((abut.BadInput, "law_of gives 3", dict(several, law_of=lambda a, b: 3)),
                                     (abut.BadInput, "law_of", several),
                                     (abut.BadInput, "laws: decay_slip is 0", dict(laws=[dict(friction=0.1, decay_slip=0.0)])),
                                     (TypeError, "laws: there is no 'skin'", dict(laws=[dict(skin=0.1)])),
                                     (TypeError, "not given a number", dict(several, law_of=lambda a, b: "first")),
                                     (KeyError, "of the callback", dict(own_coefficient=lambda *_: {}["of the callback"])),
                                     (abut.BadInput, "friction is -1", dict(friction=-1.0))):
            with self.assertRaisesRegex(error, text):
                limit_over_force(**options)
        with self.assertRaisesRegex(abut.BadInput, "shear_stiffness"):
            made(friction=0.5)
        with self.assertRaisesRegex(ValueError, "shear_stiffness has 1 entries for 2 bodies"):
            made(friction=0.5, shear_stiffness=[1.0])

    def test_callbacks(self):
        asked = []
        contact = made(wanted=lambda a, b: asked.append((a, b)) or False)
        self.assertEqual(contact.step(1.0, REST, lowered(0.15))["active_pairs"], 0)
        self.assertIn((2, 4), asked)

        def fails(a, b):
            raise KeyError("of the callback")

        contact = made(wanted=fails)
        with self.assertRaises(KeyError):
            contact.step(1.0, REST, lowered(0.15))
        told = []
        contact = made(log=lambda severity, text: told.append(text))
        contact.step(1.0, REST, REST)
        contact.step(1.0, REST, lowered(0.19))
        self.assertEqual(len(told), 1)
        self.assertIn("pressed", told[0])
        abut.NodalContact(REST, FACES[:, ::-1], BODY, DEPTH, [3.0, 6.0], log=lambda severity, text: told.append(text))
        self.assertIn("body 1", told[-1])

    def test_exceptions_of_log_and_cancel(self):
        def fails(*_):
            raise KeyError("of the callback")

        contact = made(log=fails)
        contact.step(1.0, REST, REST)
        with self.assertRaises(KeyError):
            contact.step(1.0, REST, lowered(0.19))
        self.assertEqual(contact.report["active_pairs"], 1)  # the step has happened
        contact.step(1.0, lowered(0.19), REST)
        with self.assertRaises(KeyError):
            made(cancel=fails).step(1.0, REST, REST)
        with self.assertRaises(abut.Cancelled):
            made(cancel=lambda: True).step(1.0, REST, REST)
        self.assertEqual(made(wanted=lambda a, b: "yes").step(1.0, REST, lowered(0.15))["active_pairs"], 1)
        with self.assertRaises(abut.LimitExceeded):
            made(max_pairs=0).step(1.0, REST, lowered(0.15))

    def test_a_contact_in_use_is_left_alone(self):
        contact = made(wanted=lambda a, b: contact.step(1.0, REST, REST) is None)
        with self.assertRaisesRegex(abut.Misuse, "in use"):
            contact.step(1.0, REST, lowered(0.15))
        inside, go_on = threading.Event(), threading.Event()

        def waits(face_1, face_2):
            inside.set()
            return go_on.wait(10.0)

        shared = made(wanted=waits)
        stepping = threading.Thread(target=shared.step, args=(1.0, REST, lowered(0.15)))
        stepping.start()
        inside.wait(10.0)
        for call in (lambda: shared.step(1.0, REST, REST), lambda: shared.pairs, shared.state, lambda: shared.evaluate(REST)):
            with self.assertRaisesRegex(abut.Misuse, "in use"):
                call()
        go_on.set()
        stepping.join()
        self.assertEqual(shared.report["active_pairs"], 1)

    def test_nothing_is_written_where_it_would_be_lost(self):
        contact = made()
        contact.step(1.0, REST, REST)
        with self.assertRaisesRegex(TypeError, "array of numpy"):
            contact.step(1.0, REST, lowered(0.15), out=[[0.0, 0.0]] * 8)
        with self.assertRaisesRegex(abut.BadInput, "forces of 7 nodes"):
            contact.step(1.0, REST, lowered(0.15), out=np.zeros((7, 2)))
        self.assertEqual(len(contact.pairs), 0)

    def test_integers_are_neither_rounded_nor_wrapped(self):
        for wrong in (FACES + 0.7, FACES.astype(str), FACES.astype(complex)):
            with self.assertRaisesRegex(TypeError, "faces must be an array of integers"):
                abut.NodalContact(REST, wrong, BODY, DEPTH, [3.0, 6.0])
        with self.assertRaisesRegex(ValueError, "faces must be within"):
            abut.NodalContact(REST, FACES + 2**32, BODY, DEPTH, [3.0, 6.0])
        with self.assertRaisesRegex(TypeError, "body must be"):
            abut.find_overlaps(REST, FACES, BODY * 1.0, 0.2)
        for kind in (np.uint8, np.int16, np.int64):
            self.assertEqual(len(abut.find_overlaps(REST, FACES.astype(kind), BODY.astype(kind), 0.2)), 1)
        self.assertEqual(len(abut.find_overlaps(REST, FACES, BODY * 2000000000, 0.2)), 1)

    def test_overlaps_tell_the_distance_in_space_beside_the_gap(self):
        # A face that rises from 0.1 to 0.3 above a flat one: the gap is read between the centroids along the mean normal.
        nodes = np.array([[1.0, 0.0], [0.0, 0.0], [0.0, 0.1], [1.0, 0.3]])
        found = abut.find_overlaps(nodes, np.array([[0, 1], [2, 3]]), np.array([0, 1]), 0.25)
        self.assertEqual(len(found), 1)
        self.assertAlmostEqual(found["gap"][0], 0.2 * np.cos(np.arctan(0.2) / 2.0), delta=1e-12)
        self.assertAlmostEqual(found["distance"][0], 0.1, delta=1e-6)

    def test_what_is_wrong_is_refused_by_name(self):
        contact = made()
        contact.step(1.0, REST, REST)
        with self.assertRaisesRegex(TypeError, "float64"):
            contact.step(1.0, REST.astype(np.float32), REST)
        with self.assertRaisesRegex(ValueError, "shape"):
            contact.step(1.0, REST[:, :1], REST)
        with self.assertRaisesRegex(ValueError, "mode"):
            contact.step(1.0, REST, REST, mode="middle")
        with self.assertRaisesRegex(abut.BadInput, "dt = 0 s"):
            contact.step(0.0, REST, REST)
        frozen = np.zeros((8, 2))
        frozen.flags.writeable = False
        with self.assertRaisesRegex(ValueError, "read-only"):
            contact.step(1.0, REST, REST, out=frozen)
        with self.assertRaises(abut.BadInput):
            contact.step(1.0, REST[:5], REST[:5])
        broken = lowered(0.0)
        broken[5, 1] = math.nan
        with self.assertRaises(abut.Diverged) as raised:
            contact.step(1.0, REST, broken)
        self.assertGreaterEqual(raised.exception.face_1, 4)
        with self.assertRaises(abut.TooDeep) as raised:
            contact.step(1.0, REST, lowered(0.8))
        self.assertEqual(raised.exception.allowed, 2.0)
        self.assertGreater(raised.exception.value, 2.0)
        with self.assertRaisesRegex(abut.BadInput, "face 0 names node 8"):
            abut.NodalContact(REST, FACES + (np.arange(8) == 0)[:, None] * [8, 0], BODY, DEPTH, [3.0, 6.0])
        with self.assertRaisesRegex(ValueError, "depth has 3"):
            abut.NodalContact(REST, FACES, BODY, DEPTH[:3], [3.0, 6.0])
        self.assertTrue(issubclass(abut.TooDeep, abut.Error))

    def test_options_out_of_range_are_refused_by_name(self):
        for option, value in dict(max_pairs=-5, skin=-1.0, largest_motion=0.0, compression_warning=math.nan,
                                  compression_limit=-2.0, friction=-0.1, sliding_friction=-0.1, decay_speed=0.0, decay_slip=0.0,
                                  shear_strength=-1.0, relaxation_time=0.0).items():
            with self.assertRaisesRegex(abut.BadInput, f"{option} is "):
                made(**{option: value})
        for option, value in dict(facing_full=0.5, facing_none=0.5).items():
            with self.assertRaisesRegex(abut.BadInput, f"{option} is "):
                made(**{option: value})
        with self.assertRaisesRegex(abut.BadInput, "facing.full < facing.none"):
            made(facing_full=-0.2, facing_none=-0.5)
        with self.assertRaisesRegex(TypeError, "no option 'facing'; there are skin, .*facing_full"):
            made(facing=(-0.6, -0.2))
        with self.assertRaisesRegex(TypeError, "skin cannot be 'thick'"):
            made(skin="thick")

    def test_surfaces_that_look_inwards_warn_where_there_is_no_log(self):
        with self.assertWarnsRegex(RuntimeWarning, "body 1 close a volume and all look into it"):
            abut.NodalContact(REST, FACES[:, ::-1], BODY, DEPTH, [3.0, 6.0])
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            made()  # nothing to be told
            with self.assertRaises(RuntimeWarning):
                abut.NodalContact(REST, FACES[:, ::-1], BODY, DEPTH, [3.0, 6.0])
            told = []
            abut.NodalContact(REST, FACES[:, ::-1], BODY, DEPTH, [3.0, 6.0], log=lambda *what: told.append(what))
            self.assertEqual(len(told), 2)

    def test_a_force_that_is_not_finite_is_an_error_with_both_faces(self):
        # the second corner of face 0 passes over its third one: the face turns over within the step
        nodes = np.array([[0, 0, 3], [1, 1, 3], [0, 1, 3], [0, 0, 0], [1, 1, 0], [0, 1, 0]], dtype=float)
        contact = abut.NodalContact(nodes, [[0, 1, 2], [3, 5, 4]], [0, 1], [1e9, 0.0], [1e12, math.inf])
        turned, force = nodes.copy(), np.zeros((6, 3))
        turned[1, 0] = -1.0
        with self.assertRaisesRegex(abut.Diverged, "face 0 turns over") as raised:
            contact.step(1.0, nodes, turned, out=force)
        self.assertEqual((raised.exception.face_1, raised.exception.face_2), (0, 1))
        self.assertEqual(abs(force).max(), 0.0)

    def test_overlaps_are_found_in_any_unit_of_length(self):
        for unit in (1e-40, 1e-3, 1e3, 1e40):
            self.assertEqual(len(abut.find_overlaps(REST * unit, FACES, BODY, 0.05 * unit)), 0)
            self.assertEqual(len(abut.find_overlaps(REST * unit, FACES, BODY, 0.2 * unit)), 1)

    def test_overlaps_and_small_things(self):
        self.assertEqual(len(abut.find_overlaps(REST, FACES, BODY, 0.05)), 0)
        overlap = abut.find_overlaps(REST, FACES, BODY, 0.2)
        self.assertEqual((overlap["face_1"][0], overlap["face_2"][0]), (2, 4))
        self.assertAlmostEqual(overlap["area"][0], 0.8, delta=1e-15)
        self.assertAlmostEqual(overlap["gap"][0], 0.1, delta=1e-15)
        self.assertAlmostEqual(abut.skin_stiffness(6.0, [1.0, 2.0]), 4.0)
        step = made().stable_step(np.ones(8), 1.0)
        self.assertAlmostEqual(step["omega"], math.sqrt(5.0))
        abut.limit_threads(1)
        abut.limit_threads(0)
        with self.assertRaises(abut.BadInput):
            abut.limit_threads(-1)
        self.assertRegex(abut.__version__, r"^\d+\.\d+\.\d+$")

    def test_quadrangles_triangles_and_offsets(self):
        cube = np.array([[x, y, z] for z in (0.0, 1.0) for y in (0.0, 1.0) for x in (0.0, 1.0)])
        quads = np.array([[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]])
        nodes = np.vstack([cube, cube + [0.1, 0.05, 1.02]])
        faces = np.vstack([quads, quads + 8])
        body, depth = np.repeat([0, 1], 6), np.full(12, 0.1)
        flat = dict(faces=faces.ravel(), offsets=np.arange(0, 49, 4))
        energies = []
        for given in (dict(faces=faces), flat):
            contact = abut.NodalContact(nodes, body=body, depth=depth, stiffness=[3.0, 6.0], **given)
            pressed = nodes.copy()
            pressed[8:, 2] -= 0.05
            contact.step(1.0, nodes, nodes)
            energies.append(contact.step(1.0, nodes, pressed)["energy"])
        self.assertAlmostEqual(energies[0], 0.5 * 2.0 * 0.03**2 * 0.9 * 0.95, delta=1e-15)
        self.assertEqual(*energies)

    def test_two_threads_and_any_order_of_destruction(self):
        def work(results):
            contact, force = made(), np.zeros((8, 2))
            contact.step(1.0, REST, REST)
            for _ in range(200):
                contact.step(1.0, REST, lowered(0.15), out=force)
            results.append(force)
        results = []
        threads = [threading.Thread(target=work, args=(results,)) for _ in range(2)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        np.testing.assert_array_equal(*results)
        several = [made(wanted=lambda a, b: True) for _ in range(3)]
        pairs = several[1].pairs
        del several[1], several[0]
        gc.collect()
        self.assertEqual(len(pairs), 0)



class Surfaces(unittest.TestCase):
    POINTS = np.array([[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0], [3.0, 0.0], [3.0, 1.0]])

    def test_cells_may_be_an_array_lists_a_dict_pairs_or_blocks(self):
        class Block:
            type, data = "triangle", np.array([[0, 1, 2], [0, 3, 2]])  # the second in the other sense
        triangles = Block.data
        for cells in (triangles, triangles.tolist(), {"triangle": triangles}, [("triangle", triangles)], [Block()]):
            surface = abut.surface_of(self.POINTS, cells, with_cells=True)
            self.assertEqual(surface["faces"].reshape(-1, 2).tolist(), [[0, 1], [1, 2], [3, 0], [2, 3]])
            np.testing.assert_allclose(surface["depth"], [0.5, 1.0, 1.0, 0.5], rtol=1e-14)  # half the heights 1 and 2
            self.assertEqual(surface["cell"].tolist(), [0, 0, 1, 1])
            self.assertEqual(surface["body"].tolist(), [0] * 4)

    def test_shapes_mix(self):
        surface = abut.surface_of(self.POINTS, {"triangle": [[0, 1, 2], [0, 2, 3]], "quad": [[1, 4, 5, 2]]})
        self.assertEqual(len(surface["body"]), 6)
        np.testing.assert_allclose(surface["depth"][-3:], [0.5] * 3, rtol=1e-14)

    def test_what_cannot_be_is_refused(self):
        with self.assertRaisesRegex(abut.BadInput, "cell 1 of body 1 shares a face with cell 0 of body 0"):
            abut.surface_of(self.POINTS, [[0, 1, 2], [0, 3, 2]], [0, 1])
        with self.assertRaisesRegex(ValueError, "body has 1 entries for 2 cells"):
            abut.surface_of(self.POINTS, [[0, 1, 2], [0, 3, 2]], [0])
        with self.assertRaisesRegex(TypeError, "cells must be an array of integers"):
            abut.surface_of(self.POINTS, [[0.5, 1.0, 2.0]])

if __name__ == "__main__":
    unittest.main()
