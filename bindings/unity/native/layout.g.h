/* Generated from Knurl's headers by bindings/unity/native/mirror.py, which makes it anew; do not edit.
 * SPDX-License-Identifier: MIT */
#ifndef KNURL_UNITY_LAYOUT_H
#define KNURL_UNITY_LAYOUT_H
/* clang-format off */

#define KNURL_UNITY_INTERFACE "7f906dbfcfd98fe4"

/** The mirrored structs, as C# lays them out: STRUCT(type, bytes), FIELD(type, field, name in C#, offset, bytes). */
#define KNURL_UNITY_LAYOUT(STRUCT, FIELD) \
    STRUCT(knurl_allocator, 24) \
    FIELD(knurl_allocator, allocate, "allocate", 0, 8) \
    FIELD(knurl_allocator, release, "release", 8, 8) \
    FIELD(knurl_allocator, user, "user", 16, 8) \
    STRUCT(knurl_velocity, 11264) \
    FIELD(knurl_velocity, alignment, "alignment", 0, 8) \
    FIELD(knurl_velocity, state, "state", 8, 11256) \
    STRUCT(knurl_workspace, 128) \
    FIELD(knurl_workspace, origin, "origin", 0, 24) \
    FIELD(knurl_workspace, rotation, "rotation", 24, 72) \
    FIELD(knurl_workspace, scale, "scale", 96, 8) \
    FIELD(knurl_workspace, reserved, "reserved", 104, 24) \
    STRUCT(knurl_plane_desc, 24) \
    FIELD(knurl_plane_desc, struct_size, "struct_size", 0, 4) \
    FIELD(knurl_plane_desc, reserved, "reserved", 4, 4) \
    FIELD(knurl_plane_desc, half_extents, "half_extents", 8, 16) \
    STRUCT(knurl_mesh_desc, 56) \
    FIELD(knurl_mesh_desc, struct_size, "struct_size", 0, 4) \
    FIELD(knurl_mesh_desc, vertex_count, "vertex_count", 4, 4) \
    FIELD(knurl_mesh_desc, positions, "positions", 8, 8) \
    FIELD(knurl_mesh_desc, tangents, "tangents", 16, 8) \
    FIELD(knurl_mesh_desc, uvs, "uvs", 24, 8) \
    FIELD(knurl_mesh_desc, indices, "indices", 32, 8) \
    FIELD(knurl_mesh_desc, index_count, "index_count", 40, 8) \
    FIELD(knurl_mesh_desc, normals, "normals", 48, 8) \
    STRUCT(knurl_vibration_event, 32) \
    FIELD(knurl_vibration_event, positive, "positive", 0, 8) \
    FIELD(knurl_vibration_event, negative, "negative", 8, 8) \
    FIELD(knurl_vibration_event, length, "length", 16, 4) \
    FIELD(knurl_vibration_event, positive_ticks, "positive_ticks", 20, 4) \
    FIELD(knurl_vibration_event, kind, "kind", 24, 4) \
    FIELD(knurl_vibration_event, above_nyquist, "above_nyquist", 28, 4) \
    STRUCT(knurl_wave, 96) \
    FIELD(knurl_wave, period_ticks, "period_ticks", 0, 8) \
    FIELD(knurl_wave, amplitude, "amplitude", 8, 8) \
    FIELD(knurl_wave, parts[0], "parts_0", 16, 32) \
    FIELD(knurl_wave, parts[1], "parts_1", 48, 32) \
    FIELD(knurl_wave, method, "method", 80, 4) \
    FIELD(knurl_wave, part_count, "part_count", 84, 4) \
    FIELD(knurl_wave, above_nyquist, "above_nyquist", 88, 4) \
    FIELD(knurl_wave, reserved, "reserved", 92, 4) \
    STRUCT(knurl_grating, 56) \
    FIELD(knurl_grating, method, "method", 0, 4) \
    FIELD(knurl_grating, reserved, "reserved", 4, 12) \
    FIELD(knurl_grating, spatial_frequency, "spatial_frequency", 16, 16) \
    FIELD(knurl_grating, amplitude, "amplitude", 32, 8) \
    FIELD(knurl_grating, update_rate_hz, "update_rate_hz", 40, 8) \
    FIELD(knurl_grating, resolution, "resolution", 48, 8) \
    STRUCT(knurl_grating_state, 112) \
    FIELD(knurl_grating_state, event, "event", 0, 32) \
    FIELD(knurl_grating_state, event_count, "event_count", 32, 8) \
    FIELD(knurl_grating_state, next_tick, "next_tick", 40, 4) \
    FIELD(knurl_grating_state, playing, "playing", 44, 4) \
    FIELD(knurl_grating_state, moving, "moving", 48, 4) \
    FIELD(knurl_grating_state, sign, "sign", 52, 4) \
    FIELD(knurl_grating_state, tracked, "tracked", 56, 16) \
    FIELD(knurl_grating_state, phase, "phase", 72, 8) \
    FIELD(knurl_grating_state, offset, "offset", 80, 8) \
    FIELD(knurl_grating_state, axis, "axis", 88, 4) \
    FIELD(knurl_grating_state, direction, "direction", 92, 4) \
    FIELD(knurl_grating_state, reserved, "reserved", 96, 16) \
    STRUCT(knurl_grating_output, 48) \
    FIELD(knurl_grating_output, height, "height", 0, 8) \
    FIELD(knurl_grating_output, spatial_frequency, "spatial_frequency", 8, 8) \
    FIELD(knurl_grating_output, temporal_frequency, "temporal_frequency", 16, 8) \
    FIELD(knurl_grating_output, event, "event", 24, 8) \
    FIELD(knurl_grating_output, above_nyquist, "above_nyquist", 32, 4) \
    FIELD(knurl_grating_output, turned, "turned", 36, 4) \
    FIELD(knurl_grating_output, reserved, "reserved", 40, 8) \
    STRUCT(knurl_method_input, 64) \
    FIELD(knurl_method_input, cycles, "cycles", 0, 16) \
    FIELD(knurl_method_input, velocity, "velocity", 16, 16) \
    FIELD(knurl_method_input, spatial_frequency, "spatial_frequency", 32, 16) \
    FIELD(knurl_method_input, temporal_frequency, "temporal_frequency", 48, 8) \
    FIELD(knurl_method_input, period, "period", 56, 8) \
    STRUCT(knurl_material_desc, 64) \
    FIELD(knurl_material_desc, struct_size, "struct_size", 0, 4) \
    FIELD(knurl_material_desc, method, "method", 4, 4) \
    FIELD(knurl_material_desc, spatial_frequency, "spatial_frequency", 8, 16) \
    FIELD(knurl_material_desc, amplitude, "amplitude", 24, 8) \
    FIELD(knurl_material_desc, stiffness, "stiffness", 32, 8) \
    FIELD(knurl_material_desc, damping, "damping", 40, 8) \
    FIELD(knurl_material_desc, friction, "friction", 48, 8) \
    FIELD(knurl_material_desc, orientation, "orientation", 56, 8) \
    STRUCT(knurl_surface_desc, 160) \
    FIELD(knurl_surface_desc, struct_size, "struct_size", 0, 4) \
    FIELD(knurl_surface_desc, double_sided, "double_sided", 4, 4) \
    FIELD(knurl_surface_desc, name, "name", 8, 8) \
    FIELD(knurl_surface_desc, plane, "plane", 16, 8) \
    FIELD(knurl_surface_desc, mesh, "mesh", 24, 8) \
    FIELD(knurl_surface_desc, material, "material", 32, 8) \
    FIELD(knurl_surface_desc, position, "position", 40, 24) \
    FIELD(knurl_surface_desc, rotation, "rotation", 64, 32) \
    FIELD(knurl_surface_desc, normal, "normal", 96, 24) \
    FIELD(knurl_surface_desc, axis, "axis", 120, 24) \
    FIELD(knurl_surface_desc, shape_of, "shape_of", 144, 8) \
    FIELD(knurl_surface_desc, coordinates, "coordinates", 152, 4) \
    FIELD(knurl_surface_desc, smooth, "smooth", 156, 4) \
    STRUCT(knurl_scene_desc, 24) \
    FIELD(knurl_scene_desc, struct_size, "struct_size", 0, 4) \
    FIELD(knurl_scene_desc, max_surfaces, "max_surfaces", 4, 4) \
    FIELD(knurl_scene_desc, hip_count, "hip_count", 8, 4) \
    FIELD(knurl_scene_desc, full_model, "full_model", 12, 4) \
    FIELD(knurl_scene_desc, allocator, "allocator", 16, 8) \
    STRUCT(knurl_hip_desc, 96) \
    FIELD(knurl_hip_desc, struct_size, "struct_size", 0, 4) \
    FIELD(knurl_hip_desc, protections, "protections", 4, 4) \
    FIELD(knurl_hip_desc, clamp, "clamp", 8, 4) \
    FIELD(knurl_hip_desc, reserved, "reserved", 12, 4) \
    FIELD(knurl_hip_desc, workspace, "workspace", 16, 8) \
    FIELD(knurl_hip_desc, update_rate_hz, "update_rate_hz", 24, 8) \
    FIELD(knurl_hip_desc, resolution, "resolution", 32, 8) \
    FIELD(knurl_hip_desc, max_force, "max_force", 40, 8) \
    FIELD(knurl_hip_desc, continuous_force, "continuous_force", 48, 8) \
    FIELD(knurl_hip_desc, heat_time, "heat_time", 56, 8) \
    FIELD(knurl_hip_desc, viscous, "viscous", 64, 8) \
    FIELD(knurl_hip_desc, delay, "delay", 72, 8) \
    FIELD(knurl_hip_desc, max_stiffness, "max_stiffness", 80, 8) \
    FIELD(knurl_hip_desc, slew_rate, "slew_rate", 88, 8) \
    STRUCT(knurl_gain, 16) \
    FIELD(knurl_gain, hz, "hz", 0, 8) \
    FIELD(knurl_gain, gain, "gain", 8, 8) \
    STRUCT(knurl_tick_input, 104) \
    FIELD(knurl_tick_input, position, "position", 0, 24) \
    FIELD(knurl_tick_input, velocity, "velocity", 24, 24) \
    FIELD(knurl_tick_input, has_velocity, "has_velocity", 48, 4) \
    FIELD(knurl_tick_input, absent, "absent", 52, 4) \
    FIELD(knurl_tick_input, attenuation, "attenuation", 56, 8) \
    FIELD(knurl_tick_input, paused, "paused", 64, 4) \
    FIELD(knurl_tick_input, reserved, "reserved", 68, 36) \
    STRUCT(knurl_tick_output, 288) \
    FIELD(knurl_tick_output, device_force, "device_force", 0, 24) \
    FIELD(knurl_tick_output, force, "force", 24, 24) \
    FIELD(knurl_tick_output, hip, "hip", 48, 24) \
    FIELD(knurl_tick_output, hip_velocity, "hip_velocity", 72, 24) \
    FIELD(knurl_tick_output, proxy, "proxy", 96, 24) \
    FIELD(knurl_tick_output, normal, "normal", 120, 24) \
    FIELD(knurl_tick_output, surface_velocity, "surface_velocity", 144, 16) \
    FIELD(knurl_tick_output, depth, "depth", 160, 8) \
    FIELD(knurl_tick_output, height, "height", 168, 8) \
    FIELD(knurl_tick_output, spatial_frequency, "spatial_frequency", 176, 8) \
    FIELD(knurl_tick_output, temporal_frequency, "temporal_frequency", 184, 8) \
    FIELD(knurl_tick_output, event, "event", 192, 8) \
    FIELD(knurl_tick_output, surface, "surface", 200, 8) \
    FIELD(knurl_tick_output, tick, "tick", 208, 8) \
    FIELD(knurl_tick_output, flags, "flags", 216, 4) \
    FIELD(knurl_tick_output, contacts, "contacts", 220, 4) \
    FIELD(knurl_tick_output, cycles, "cycles", 224, 16) \
    FIELD(knurl_tick_output, reserved, "reserved", 240, 48) \
    STRUCT(knurl_hip_counts, 160) \
    FIELD(knurl_hip_counts, ticks, "ticks", 0, 8) \
    FIELD(knurl_hip_counts, contact_ticks, "contact_ticks", 8, 8) \
    FIELD(knurl_hip_counts, events, "events", 16, 8) \
    FIELD(knurl_hip_counts, force_limit_ticks, "force_limit_ticks", 24, 8) \
    FIELD(knurl_hip_counts, above_nyquist_ticks, "above_nyquist_ticks", 32, 8) \
    FIELD(knurl_hip_counts, non_finite_ticks, "non_finite_ticks", 40, 8) \
    FIELD(knurl_hip_counts, entry_ticks, "entry_ticks", 48, 8) \
    FIELD(knurl_hip_counts, slew_ticks, "slew_ticks", 56, 8) \
    FIELD(knurl_hip_counts, heat_ticks, "heat_ticks", 64, 8) \
    FIELD(knurl_hip_counts, passivity_ticks, "passivity_ticks", 72, 8) \
    FIELD(knurl_hip_counts, force_max, "force_max", 80, 8) \
    FIELD(knurl_hip_counts, heat, "heat", 88, 8) \
    FIELD(knurl_hip_counts, half_cycles_crossed, "half_cycles_crossed", 96, 8) \
    FIELD(knurl_hip_counts, half_cycles_played, "half_cycles_played", 104, 8) \
    FIELD(knurl_hip_counts, squeezed_ticks, "squeezed_ticks", 112, 8) \
    FIELD(knurl_hip_counts, visit_limit_ticks, "visit_limit_ticks", 120, 8) \
    FIELD(knurl_hip_counts, reserved, "reserved", 128, 32) \
    STRUCT(knurl_hip_contact, 112) \
    FIELD(knurl_hip_contact, surface, "surface", 0, 8) \
    FIELD(knurl_hip_contact, proxy, "proxy", 8, 24) \
    FIELD(knurl_hip_contact, normal, "normal", 32, 24) \
    FIELD(knurl_hip_contact, depth, "depth", 56, 8) \
    FIELD(knurl_hip_contact, reserved, "reserved", 64, 48) \
    STRUCT(knurl_audio_desc, 40) \
    FIELD(knurl_audio_desc, struct_size, "struct_size", 0, 4) \
    FIELD(knurl_audio_desc, is_offline, "is_offline", 4, 4) \
    FIELD(knurl_audio_desc, update_rate_hz, "update_rate_hz", 8, 8) \
    FIELD(knurl_audio_desc, sample_rate_hz, "sample_rate_hz", 16, 8) \
    FIELD(knurl_audio_desc, latency_s, "latency_s", 24, 8) \
    FIELD(knurl_audio_desc, voice, "voice", 32, 4) \
    FIELD(knurl_audio_desc, reserved, "reserved", 36, 4) \
    STRUCT(knurl_device_info, 216) \
    FIELD(knurl_device_info, struct_size, "struct_size", 0, 4) \
    FIELD(knurl_device_info, reserved, "reserved", 4, 4) \
    FIELD(knurl_device_info, name, "name", 8, 64) \
    FIELD(knurl_device_info, workspace_min, "workspace_min", 72, 24) \
    FIELD(knurl_device_info, workspace_max, "workspace_max", 96, 24) \
    FIELD(knurl_device_info, resolution, "resolution", 120, 8) \
    FIELD(knurl_device_info, max_force, "max_force", 128, 8) \
    FIELD(knurl_device_info, delay, "delay", 136, 8) \
    FIELD(knurl_device_info, continuous_force, "continuous_force", 144, 8) \
    FIELD(knurl_device_info, heat_time, "heat_time", 152, 8) \
    FIELD(knurl_device_info, mass, "mass", 160, 8) \
    FIELD(knurl_device_info, viscous, "viscous", 168, 8) \
    FIELD(knurl_device_info, coulomb, "coulomb", 176, 8) \
    FIELD(knurl_device_info, max_stiffness, "max_stiffness", 184, 8) \
    FIELD(knurl_device_info, native_rate, "native_rate", 192, 8) \
    FIELD(knurl_device_info, max_torque, "max_torque", 200, 8) \
    FIELD(knurl_device_info, max_grip, "max_grip", 208, 8) \
    STRUCT(knurl_device_sample, 168) \
    FIELD(knurl_device_sample, position, "position", 0, 24) \
    FIELD(knurl_device_sample, orientation, "orientation", 24, 32) \
    FIELD(knurl_device_sample, grip, "grip", 56, 8) \
    FIELD(knurl_device_sample, joints, "joints", 64, 64) \
    FIELD(knurl_device_sample, buttons, "buttons", 128, 4) \
    FIELD(knurl_device_sample, joint_count, "joint_count", 132, 4) \
    FIELD(knurl_device_sample, reserved, "reserved", 136, 32) \
    STRUCT(knurl_device_torque, 64) \
    FIELD(knurl_device_torque, torque, "torque", 0, 24) \
    FIELD(knurl_device_torque, grip, "grip", 24, 8) \
    FIELD(knurl_device_torque, reserved, "reserved", 32, 32) \
    STRUCT(knurl_device_listing, 1440) \
    FIELD(knurl_device_listing, uri, "uri", 0, 256) \
    FIELD(knurl_device_listing, name, "name", 256, 128) \
    FIELD(knurl_device_listing, reason, "reason", 384, 1024) \
    FIELD(knurl_device_listing, reserved, "reserved", 1408, 32) \
    STRUCT(knurl_device_event, 24) \
    FIELD(knurl_device_event, time_ns, "time_ns", 0, 8) \
    FIELD(knurl_device_event, value, "value", 8, 8) \
    FIELD(knurl_device_event, code, "code", 16, 4) \
    FIELD(knurl_device_event, reserved, "reserved", 20, 4) \
    STRUCT(knurl_device_status, 104) \
    FIELD(knurl_device_status, struct_size, "struct_size", 0, 4) \
    FIELD(knurl_device_status, lost, "lost", 4, 4) \
    FIELD(knurl_device_status, halted, "halted", 8, 4) \
    FIELD(knurl_device_status, buttons, "buttons", 12, 4) \
    FIELD(knurl_device_status, exchanges, "exchanges", 16, 8) \
    FIELD(knurl_device_status, bad_bytes, "bad_bytes", 24, 8) \
    FIELD(knurl_device_status, events, "events", 32, 8) \
    FIELD(knurl_device_status, exchange_ns_p50, "exchange_ns_p50", 40, 8) \
    FIELD(knurl_device_status, exchange_ns_p99, "exchange_ns_p99", 48, 8) \
    FIELD(knurl_device_status, orientation, "orientation", 56, 32) \
    FIELD(knurl_device_status, grip, "grip", 88, 8) \
    FIELD(knurl_device_status, battery, "battery", 96, 8) \
    STRUCT(knurl_device_functions, 72) \
    FIELD(knurl_device_functions, struct_size, "struct_size", 0, 4) \
    FIELD(knurl_device_functions, blocking, "blocking", 4, 4) \
    FIELD(knurl_device_functions, user, "user", 8, 8) \
    FIELD(knurl_device_functions, get_info, "get_info", 16, 8) \
    FIELD(knurl_device_functions, start, "start", 24, 8) \
    FIELD(knurl_device_functions, read, "read", 32, 8) \
    FIELD(knurl_device_functions, write, "write", 40, 8) \
    FIELD(knurl_device_functions, reopen, "reopen", 48, 8) \
    FIELD(knurl_device_functions, close, "close", 56, 8) \
    FIELD(knurl_device_functions, motors_known, "motors_known", 64, 4) \
    FIELD(knurl_device_functions, reserved, "reserved", 68, 4) \
    STRUCT(knurl_effect, 120) \
    FIELD(knurl_effect, kind, "kind", 0, 4) \
    FIELD(knurl_effect, reserved_bits, "reserved_bits", 4, 4) \
    FIELD(knurl_effect, anchor, "anchor", 8, 24) \
    FIELD(knurl_effect, axis, "axis", 32, 24) \
    FIELD(knurl_effect, stiffness, "stiffness", 56, 8) \
    FIELD(knurl_effect, damping, "damping", 64, 8) \
    FIELD(knurl_effect, spacing, "spacing", 72, 8) \
    FIELD(knurl_effect, max_force, "max_force", 80, 8) \
    FIELD(knurl_effect, reserved, "reserved", 88, 32) \
    STRUCT(knurl_stroke_desc, 136) \
    FIELD(knurl_stroke_desc, struct_size, "struct_size", 0, 4) \
    FIELD(knurl_stroke_desc, stroke, "stroke", 4, 4) \
    FIELD(knurl_stroke_desc, centre, "centre", 8, 24) \
    FIELD(knurl_stroke_desc, x, "x", 32, 24) \
    FIELD(knurl_stroke_desc, normal, "normal", 56, 24) \
    FIELD(knurl_stroke_desc, reach, "reach", 80, 16) \
    FIELD(knurl_stroke_desc, depth, "depth", 96, 8) \
    FIELD(knurl_stroke_desc, speed, "speed", 104, 8) \
    FIELD(knurl_stroke_desc, period, "period", 112, 8) \
    FIELD(knurl_stroke_desc, path, "path", 120, 8) \
    FIELD(knurl_stroke_desc, path_rows, "path_rows", 128, 4) \
    FIELD(knurl_stroke_desc, path_loop, "path_loop", 132, 4) \
    STRUCT(knurl_fake_truth, 96) \
    FIELD(knurl_fake_truth, position, "position", 0, 24) \
    FIELD(knurl_fake_truth, velocity, "velocity", 24, 24) \
    FIELD(knurl_fake_truth, motor, "motor", 48, 24) \
    FIELD(knurl_fake_truth, hand, "hand", 72, 24) \
    STRUCT(knurl_gltf_options, 72) \
    FIELD(knurl_gltf_options, struct_size, "struct_size", 0, 4) \
    FIELD(knurl_gltf_options, max_surfaces, "max_surfaces", 4, 4) \
    FIELD(knurl_gltf_options, max_bytes, "max_bytes", 8, 8) \
    FIELD(knurl_gltf_options, max_vertices, "max_vertices", 16, 8) \
    FIELD(knurl_gltf_options, max_triangles, "max_triangles", 24, 8) \
    FIELD(knurl_gltf_options, max_seconds, "max_seconds", 32, 8) \
    FIELD(knurl_gltf_options, file_read, "file_read", 40, 8) \
    FIELD(knurl_gltf_options, progress, "progress", 48, 8) \
    FIELD(knurl_gltf_options, user, "user", 56, 8) \
    FIELD(knurl_gltf_options, wrong_tag, "wrong_tag", 64, 8) \
    STRUCT(knurl_gltf_report, 16) \
    FIELD(knurl_gltf_report, struct_size, "struct_size", 0, 4) \
    FIELD(knurl_gltf_report, surfaces, "surfaces", 4, 4) \
    FIELD(knurl_gltf_report, skipped, "skipped", 8, 4) \
    FIELD(knurl_gltf_report, reserved, "reserved", 12, 4) \
    STRUCT(knurl_gltf_texture, 88) \
    FIELD(knurl_gltf_texture, struct_size, "struct_size", 0, 4) \
    FIELD(knurl_gltf_texture, texcoord, "texcoord", 4, 4) \
    FIELD(knurl_gltf_texture, use, "use", 8, 8) \
    FIELD(knurl_gltf_texture, name, "name", 16, 8) \
    FIELD(knurl_gltf_texture, data, "data", 24, 8) \
    FIELD(knurl_gltf_texture, size, "size", 32, 8) \
    FIELD(knurl_gltf_texture, problem, "problem", 40, 8) \
    FIELD(knurl_gltf_texture, from_uv, "from_uv", 48, 32) \
    FIELD(knurl_gltf_texture, scale, "scale", 80, 8) \
    STRUCT(knurl_clock, 24) \
    FIELD(knurl_clock, now_ns, "now_ns", 0, 8) \
    FIELD(knurl_clock, sleep_until_ns, "sleep_until_ns", 8, 8) \
    FIELD(knurl_clock, user, "user", 16, 8) \
    STRUCT(knurl_loop_desc, 112) \
    FIELD(knurl_loop_desc, struct_size, "struct_size", 0, 4) \
    FIELD(knurl_loop_desc, hip, "hip", 4, 4) \
    FIELD(knurl_loop_desc, device, "device", 8, 8) \
    FIELD(knurl_loop_desc, scene, "scene", 16, 8) \
    FIELD(knurl_loop_desc, force_callback, "force_callback", 24, 8) \
    FIELD(knurl_loop_desc, tick_callback, "tick_callback", 32, 8) \
    FIELD(knurl_loop_desc, user, "user", 40, 8) \
    FIELD(knurl_loop_desc, update_rate_hz, "update_rate_hz", 48, 8) \
    FIELD(knurl_loop_desc, tick_limit, "tick_limit", 56, 8) \
    FIELD(knurl_loop_desc, ramp_s, "ramp_s", 64, 8) \
    FIELD(knurl_loop_desc, watchdog_s, "watchdog_s", 72, 8) \
    FIELD(knurl_loop_desc, clock, "clock", 80, 8) \
    FIELD(knurl_loop_desc, protections, "protections", 88, 4) \
    FIELD(knurl_loop_desc, reconnect, "reconnect", 92, 4) \
    FIELD(knurl_loop_desc, heartbeat_s, "heartbeat_s", 96, 8) \
    FIELD(knurl_loop_desc, torque_callback, "torque_callback", 104, 8) \
    STRUCT(knurl_percentiles, 24) \
    FIELD(knurl_percentiles, p50, "p50", 0, 8) \
    FIELD(knurl_percentiles, p99, "p99", 8, 8) \
    FIELD(knurl_percentiles, max, "max", 16, 8) \
    STRUCT(knurl_loop_stats, 128) \
    FIELD(knurl_loop_stats, struct_size, "struct_size", 0, 4) \
    FIELD(knurl_loop_stats, state, "state", 4, 4) \
    FIELD(knurl_loop_stats, ticks, "ticks", 8, 8) \
    FIELD(knurl_loop_stats, overruns, "overruns", 16, 8) \
    FIELD(knurl_loop_stats, watchdog_trips, "watchdog_trips", 24, 8) \
    FIELD(knurl_loop_stats, realtime, "realtime", 32, 4) \
    FIELD(knurl_loop_stats, memory_locked, "memory_locked", 36, 4) \
    FIELD(knurl_loop_stats, tick_ns, "tick_ns", 40, 24) \
    FIELD(knurl_loop_stats, jitter_ns, "jitter_ns", 64, 24) \
    FIELD(knurl_loop_stats, heat_ticks, "heat_ticks", 88, 8) \
    FIELD(knurl_loop_stats, heat, "heat", 96, 8) \
    FIELD(knurl_loop_stats, absences, "absences", 104, 8) \
    FIELD(knurl_loop_stats, absent, "absent", 112, 4) \
    FIELD(knurl_loop_stats, paused, "paused", 116, 4) \
    FIELD(knurl_loop_stats, io_realtime, "io_realtime", 120, 4) \
    FIELD(knurl_loop_stats, reserved, "reserved", 124, 4) \
    STRUCT(knurl_surface_info, 656) \
    FIELD(knurl_surface_info, struct_size, "struct_size", 0, 4) \
    FIELD(knurl_surface_info, triangle_count, "triangle_count", 4, 4) \
    FIELD(knurl_surface_info, dropped_triangles, "dropped_triangles", 8, 4) \
    FIELD(knurl_surface_info, double_sided, "double_sided", 12, 4) \
    FIELD(knurl_surface_info, name, "name", 16, 256) \
    FIELD(knurl_surface_info, shape, "shape", 272, 8) \
    FIELD(knurl_surface_info, model, "model", 280, 8) \
    FIELD(knurl_surface_info, bytes, "bytes", 288, 8) \
    FIELD(knurl_surface_info, bounds_min, "bounds_min", 296, 24) \
    FIELD(knurl_surface_info, bounds_max, "bounds_max", 320, 24) \
    FIELD(knurl_surface_info, anchor, "anchor", 344, 24) \
    FIELD(knurl_surface_info, anchor_x, "anchor_x", 368, 24) \
    FIELD(knurl_surface_info, anchor_normal, "anchor_normal", 392, 24) \
    FIELD(knurl_surface_info, anchor_reach, "anchor_reach", 416, 32) \
    FIELD(knurl_surface_info, stretch, "stretch", 448, 24) \
    FIELD(knurl_surface_info, why, "why", 472, 8) \
    FIELD(knurl_surface_info, model_error, "model_error", 480, 8) \
    FIELD(knurl_surface_info, reversed_twins, "reversed_twins", 488, 4) \
    FIELD(knurl_surface_info, turned_triangles, "turned_triangles", 492, 4) \
    FIELD(knurl_surface_info, axis, "axis", 496, 24) \
    FIELD(knurl_surface_info, stretch_y, "stretch_y", 520, 24) \
    FIELD(knurl_surface_info, seam, "seam", 544, 8) \
    FIELD(knurl_surface_info, touching_pairs, "touching_pairs", 552, 8) \
    FIELD(knurl_surface_info, curved_triangles, "curved_triangles", 560, 4) \
    FIELD(knurl_surface_info, bad_normals, "bad_normals", 564, 4) \
    FIELD(knurl_surface_info, bulge, "bulge", 568, 8) \
    FIELD(knurl_surface_info, coordinates, "coordinates", 576, 8) \
    FIELD(knurl_surface_info, uneven, "uneven", 584, 8) \
    FIELD(knurl_surface_info, projection_seams, "projection_seams", 592, 4) \
    FIELD(knurl_surface_info, smooth, "smooth", 596, 4) \
    FIELD(knurl_surface_info, edges, "edges", 600, 4) \
    FIELD(knurl_surface_info, hard_edges, "hard_edges", 604, 4) \
    FIELD(knurl_surface_info, facet_angle, "facet_angle", 608, 16) \
    FIELD(knurl_surface_info, felt_angle, "felt_angle", 624, 16) \
    FIELD(knurl_surface_info, uv_scale, "uv_scale", 640, 16) \
    STRUCT(knurl_surface_point, 72) \
    FIELD(knurl_surface_point, struct_size, "struct_size", 0, 4) \
    FIELD(knurl_surface_point, hint, "hint", 4, 4) \
    FIELD(knurl_surface_point, surface, "surface", 8, 8) \
    FIELD(knurl_surface_point, distance, "distance", 16, 8) \
    FIELD(knurl_surface_point, position, "position", 24, 24) \
    FIELD(knurl_surface_point, normal, "normal", 48, 24) \
    STRUCT(knurl_surface_check, 1088) \
    FIELD(knurl_surface_check, struct_size, "struct_size", 0, 4) \
    FIELD(knurl_surface_check, exceeded, "exceeded", 4, 4) \
    FIELD(knurl_surface_check, stiffness, "stiffness", 8, 8) \
    FIELD(knurl_surface_check, stiffness_limit, "stiffness_limit", 16, 8) \
    FIELD(knurl_surface_check, amplitude, "amplitude", 24, 8) \
    FIELD(knurl_surface_check, amplitude_limit, "amplitude_limit", 32, 8) \
    FIELD(knurl_surface_check, message, "message", 40, 1024) \
    FIELD(knurl_surface_check, lowest_gain, "lowest_gain", 1064, 8) \
    FIELD(knurl_surface_check, lowered_hz, "lowered_hz", 1072, 16) \
    STRUCT(knurl_stroke_report, 24) \
    FIELD(knurl_stroke_report, struct_size, "struct_size", 0, 4) \
    FIELD(knurl_stroke_report, is_outside, "is_outside", 4, 4) \
    FIELD(knurl_stroke_report, follows, "follows", 8, 4) \
    FIELD(knurl_stroke_report, reserved, "reserved", 12, 4) \
    FIELD(knurl_stroke_report, length, "length", 16, 8) \
    STRUCT(knurl_session_desc, 192) \
    FIELD(knurl_session_desc, struct_size, "struct_size", 0, 4) \
    FIELD(knurl_session_desc, reconnect, "reconnect", 4, 4) \
    FIELD(knurl_session_desc, clamp, "clamp", 8, 4) \
    FIELD(knurl_session_desc, even, "even", 12, 4) \
    FIELD(knurl_session_desc, device, "device", 16, 8) \
    FIELD(knurl_session_desc, stroke, "stroke", 24, 8) \
    FIELD(knurl_session_desc, update_rate_hz, "update_rate_hz", 32, 8) \
    FIELD(knurl_session_desc, heartbeat_s, "heartbeat_s", 40, 8) \
    FIELD(knurl_session_desc, workspace, "workspace", 48, 128) \
    FIELD(knurl_session_desc, response, "response", 176, 8) \
    FIELD(knurl_session_desc, response_size, "response_size", 184, 8) \
    STRUCT(knurl_session_state, 224) \
    FIELD(knurl_session_state, hip, "hip", 0, 24) \
    FIELD(knurl_session_state, proxy, "proxy", 24, 24) \
    FIELD(knurl_session_state, force, "force", 48, 24) \
    FIELD(knurl_session_state, height, "height", 72, 8) \
    FIELD(knurl_session_state, temporal_frequency, "temporal_frequency", 80, 8) \
    FIELD(knurl_session_state, surface, "surface", 88, 8) \
    FIELD(knurl_session_state, ticks, "ticks", 96, 8) \
    FIELD(knurl_session_state, overruns, "overruns", 104, 8) \
    FIELD(knurl_session_state, buttons, "buttons", 112, 4) \
    FIELD(knurl_session_state, running, "running", 116, 4) \
    FIELD(knurl_session_state, in_contact, "in_contact", 120, 4) \
    FIELD(knurl_session_state, paused, "paused", 124, 4) \
    FIELD(knurl_session_state, velocity, "velocity", 128, 24) \
    FIELD(knurl_session_state, depth, "depth", 152, 8) \
    FIELD(knurl_session_state, impulse, "impulse", 160, 24) \
    FIELD(knurl_session_state, stylus, "stylus", 184, 32) \
    FIELD(knurl_session_state, ridges, "ridges", 216, 8) \
    STRUCT(knurl_session_event, 24) \
    FIELD(knurl_session_event, kind, "kind", 0, 4) \
    FIELD(knurl_session_event, code, "code", 4, 4) \
    FIELD(knurl_session_event, value, "value", 8, 8) \
    FIELD(knurl_session_event, surface, "surface", 16, 8) \
    STRUCT(knurl_session_way, 136) \
    FIELD(knurl_session_way, position, "position", 0, 24) \
    FIELD(knurl_session_way, rotation, "rotation", 24, 32) \
    FIELD(knurl_session_way, times, "times", 56, 16) \
    FIELD(knurl_session_way, speeds, "speeds", 72, 16) \
    FIELD(knurl_session_way, changes, "changes", 88, 16) \
    FIELD(knurl_session_way, lag, "lag", 104, 8) \
    FIELD(knurl_session_way, tick, "tick", 112, 8) \
    FIELD(knurl_session_way, clock, "clock", 120, 4) \
    FIELD(knurl_session_way, is_guess, "is_guess", 124, 4) \
    FIELD(knurl_session_way, moved, "moved", 128, 4) \
    FIELD(knurl_session_way, reserved, "reserved", 132, 4) \
    STRUCT(knurl_session_pose, 200) \
    FIELD(knurl_session_pose, position, "position", 0, 24) \
    FIELD(knurl_session_pose, rotation, "rotation", 24, 72) \
    FIELD(knurl_session_pose, quaternion, "quaternion", 96, 32) \
    FIELD(knurl_session_pose, rest, "rest", 128, 72) \
    STRUCT(knurl_unity_layout_row, 24) \
    FIELD(knurl_unity_layout_row, type, "type", 0, 8) \
    FIELD(knurl_unity_layout_row, field, "field", 8, 8) \
    FIELD(knurl_unity_layout_row, offset, "offset", 16, 4) \
    FIELD(knurl_unity_layout_row, size, "size", 20, 4)

#endif
