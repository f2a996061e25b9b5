/* The part of the engine's interface that the binding uses: a table of interface functions, a table of engine methods,
 * and wrappers of its values. Everything here is for the main thread. SPDX-License-Identifier: MIT */
#ifndef KNURL_GODOT_API_H
#define KNURL_GODOT_API_H

#include <gdextension_interface.h>
#include <knurl/base.h>

#include <string.h>

/* Interface functions: the variable part of their type's name, and the name for get_proc_address(). */
#define GD_FUNCTIONS(X)                                                                                                \
    X(PrintErrorWithMessage, print_error_with_message)                                                                 \
    X(PrintWarningWithMessage, print_warning_with_message)                                                             \
    X(StringNameNewWithUtf8Chars, string_name_new_with_utf8_chars)                                                     \
    X(StringNewWithUtf8Chars, string_new_with_utf8_chars)                                                              \
    X(StringToUtf8Chars, string_to_utf8_chars)                                                                         \
    X(VariantNewCopy, variant_new_copy)                                                                                \
    X(VariantNewNil, variant_new_nil)                                                                                  \
    X(VariantDestroy, variant_destroy)                                                                                 \
    X(VariantGetType, variant_get_type)                                                                                \
    X(VariantStringify, variant_stringify)                                                                             \
    X(VariantCanConvertStrict, variant_can_convert_strict)                                                             \
    X(GetVariantFromTypeConstructor, get_variant_from_type_constructor)                                                \
    X(GetVariantToTypeConstructor, get_variant_to_type_constructor)                                                    \
    X(VariantGetPtrConstructor, variant_get_ptr_constructor)                                                           \
    X(VariantGetPtrDestructor, variant_get_ptr_destructor)                                                             \
    X(VariantGetPtrBuiltinMethod, variant_get_ptr_builtin_method)                                                      \
    X(PackedFloat32ArrayOperatorIndex, packed_float32_array_operator_index)                                            \
    X(PackedFloat32ArrayOperatorIndexConst, packed_float32_array_operator_index_const)                                 \
    X(PackedFloat64ArrayOperatorIndex, packed_float64_array_operator_index)                                            \
    X(PackedFloat64ArrayOperatorIndexConst, packed_float64_array_operator_index_const)                                 \
    X(PackedInt32ArrayOperatorIndexConst, packed_int32_array_operator_index_const)                                     \
    X(PackedVector2ArrayOperatorIndexConst, packed_vector2_array_operator_index_const)                                 \
    X(PackedVector3ArrayOperatorIndexConst, packed_vector3_array_operator_index_const)                                 \
    X(ArrayOperatorIndexConst, array_operator_index_const)                                                             \
    X(DictionaryOperatorIndex, dictionary_operator_index)                                                              \
    X(ObjectMethodBindCall, object_method_bind_call)                                                                   \
    X(ObjectMethodBindPtrcall, object_method_bind_ptrcall)                                                             \
    X(ObjectSetInstance, object_set_instance)                                                                          \
    X(ObjectSetInstanceBinding, object_set_instance_binding)                                                           \
    X(ObjectGetInstanceBinding, object_get_instance_binding)                                                           \
    X(ObjectCastTo, object_cast_to)                                                                                    \
    X(ObjectDestroy, object_destroy)                                                                                   \
    X(ObjectGetInstanceId, object_get_instance_id)                                                                     \
    X(ObjectGetInstanceFromId, object_get_instance_from_id)                                                            \
    X(GlobalGetSingleton, global_get_singleton)                                                                        \
    X(RefSetObject, ref_set_object)                                                                                    \
    X(ClassdbConstructObject, classdb_construct_object)                                                                \
    X(ClassdbGetMethodBind, classdb_get_method_bind)                                                                   \
    X(ClassdbGetClassTag, classdb_get_class_tag)                                                                       \
    X(ClassdbRegisterExtensionClass3, classdb_register_extension_class3)                                               \
    X(ClassdbRegisterExtensionClassMethod, classdb_register_extension_class_method)                                    \
    X(ClassdbRegisterExtensionClassProperty, classdb_register_extension_class_property)                                \
    X(ClassdbRegisterExtensionClassPropertyGroup, classdb_register_extension_class_property_group)                     \
    X(ClassdbRegisterExtensionClassSignal, classdb_register_extension_class_signal)                                    \
    X(ClassdbRegisterExtensionClassIntegerConstant, classdb_register_extension_class_integer_constant)                 \
    X(ClassdbUnregisterExtensionClass, classdb_unregister_extension_class)

/* Engine methods: class, method, and the hash of its signature from extension_api.json; all are the same in 4.3 and
 * 4.6. */
#define GD_METHODS(X)                                                                                                  \
    X(Object, emit_signal, 4047867050)                                                                                 \
    X(Object, call, 3400424181)                                                                                        \
    X(RefCounted, unreference, 2240911060)                                                                             \
    X(Resource, emit_changed, 3218959716)                                                                              \
    X(Node, get_parent, 3160264692)                                                                                    \
    X(Node, get_name, 2002593661)                                                                                      \
    X(Node, is_inside_tree, 36873697)                                                                                  \
    X(Node, get_process_mode, 739966102)                                                                               \
    X(Node, set_process_internal, 2586408642)                                                                          \
    X(Node, update_configuration_warnings, 3218959716)                                                                 \
    X(Node3D, get_transform, 3229777777)                                                                               \
    X(Node3D, get_global_transform, 3229777777)                                                                        \
    X(Node3D, set_notify_transform, 2586408642)                                                                        \
    X(MeshInstance3D, get_mesh, 1808005922)                                                                            \
    X(Mesh, get_surface_count, 3905245786)                                                                             \
    X(Mesh, surface_get_arrays, 663333327)                                                                             \
    X(ArrayMesh, surface_get_primitive_type, 4141943888)                                                               \
    X(Node, get_process_delta_time, 1740695150)                                                                        \
    X(Engine, is_editor_hint, 36873697)                                                                                \
    X(Engine, is_in_physics_frame, 36873697)                                                                           \
    X(Engine, get_physics_frames, 3905245786)                                                                          \
    X(Engine, get_physics_ticks_per_second, 3905245786)                                                                \
    X(Engine, get_time_scale, 191475506)                                                                               \
    X(ProjectSettings, globalize_path, 3135753539)                                                                     \
    X(FileAccess, get_file_as_string, 1703090593)

/* Methods of built-in types. */
#define GD_BUILTINS(X)                                                                                                 \
    X(PACKED_FLOAT32_ARRAY, size, 3173160232)                                                                          \
    X(PACKED_FLOAT32_ARRAY, resize, 848867239)                                                                         \
    X(PACKED_FLOAT64_ARRAY, size, 3173160232)                                                                          \
    X(PACKED_FLOAT64_ARRAY, resize, 848867239)                                                                         \
    X(PACKED_INT32_ARRAY, size, 3173160232)                                                                            \
    X(PACKED_VECTOR2_ARRAY, size, 3173160232)                                                                          \
    X(PACKED_VECTOR3_ARRAY, size, 3173160232)                                                                          \
    X(PACKED_STRING_ARRAY, append, 816187996)                                                                          \
    X(ARRAY, size, 3173160232)                                                                                         \
    X(ARRAY, append, 3316032543)

typedef struct gd_interface {
#define GD_FIELD(type, name) GDExtensionInterface##type name;
    GD_FUNCTIONS(GD_FIELD)
#undef GD_FIELD
} gd_interface;

typedef struct gd_methods {
#define GD_FIELD(class, method, hash) GDExtensionMethodBindPtr class##_##method;
    GD_METHODS(GD_FIELD)
#undef GD_FIELD
} gd_methods;

typedef struct gd_builtins {
#define GD_FIELD(type, method, hash) GDExtensionPtrBuiltInMethod type##_##method;
    GD_BUILTINS(GD_FIELD)
#undef GD_FIELD
} gd_builtins;

/* Functions that create and destroy a value of a type, and convert it to and from a Variant; null if not needed. */
typedef struct gd_type {
    GDExtensionPtrConstructor make;
    GDExtensionPtrDestructor end;
    GDExtensionVariantFromTypeConstructorFunc to_variant;
    GDExtensionTypeFromVariantConstructorFunc from_variant;
} gd_type;

/* The engine's values, opaque, in the sizes of a build with single-precision vectors. */
typedef struct gd_name {
    uint64_t opaque;
} gd_name;

typedef struct gd_string {
    uint64_t opaque;
} gd_string;

typedef struct gd_variant {
    uint64_t opaque[3];
} gd_variant;

/* Space for a value of any type that the binding passes. */
typedef union gd_value {
    uint8_t boolean;
    int64_t integer;
    double number;
    float vector[3];
    void *object;
    gd_string string;
    uint64_t opaque[2]; /* packed arrays, arrays, dictionaries */
} gd_value;

typedef struct gd_transform {
    float basis[3][3]; /* rows */
    float origin[3];
} gd_transform;

extern gd_interface gd;
extern gd_methods gd_method;
extern gd_builtins gd_builtin;
extern gd_type gd_types[GDEXTENSION_VARIANT_TYPE_VARIANT_MAX];
extern GDExtensionClassLibraryPtr gd_library;
extern GDExtensionObjectPtr gd_engine; /* the singleton Engine */

/* Removes const: the engine's functions take pointers to read-only values without it. */
static inline void *gd_unconst(const void *pointer) {
    void *copy;
    memcpy(&copy, &pointer, sizeof copy);
    return copy;
}

/* Fills the table of functions: 1, or 0 with an error that names what is missing. */
int gd_load(GDExtensionInterfaceGetProcAddress get, GDExtensionClassLibraryPtr library);

/* Fills the other tables, once the engine has its classes: 1, or 0 with an error. */
int gd_load_classes(void);

/* Errors and warnings in the engine's log; printf style. `where` names class and method. */
void gd_error(const char *where, const char *format, ...) KNURL_PRINTF(2, 3);
void gd_warning(const char *where, const char *format, ...) KNURL_PRINTF(2, 3);

gd_name gd_name_new(const char *text);
void gd_name_end(gd_name *name);

/* Copies text into a caller's String that is initialised. */
void gd_string_set(void *string, const char *text);

/* UTF-8 out of a String, malloc'ed; null if memory runs out. */
char *gd_string_copy(const void *string);

/* Wraps a value in a new Variant, to be destroyed with gd.variant_destroy(). */
gd_variant gd_wrap(GDExtensionVariantType type, const void *value);

void gd_call(GDExtensionMethodBindPtr method, GDExtensionObjectPtr object, const void *argument, void *result);

/* Calls a method that returns a reference or a container: in a Variant that holds it, to be destroyed. index: its
 * argument; negative: no argument. */
gd_variant gd_call_variant(GDExtensionMethodBindPtr method, GDExtensionObjectPtr object, int64_t index);

/* Calls a method by name, for rare calls. Returns its result in a Variant, to be destroyed; nil, after an error, if
 * there is no such method. At most 3 arguments, still owned by the caller. */
gd_variant gd_call_named(GDExtensionObjectPtr object, const char *method, const gd_variant *arguments, uint32_t count);

/* Connects an object's signal to another object's method, or disconnects it. */
void gd_connect(GDExtensionObjectPtr from, const char *signal, GDExtensionObjectPtr to, const char *method);
void gd_disconnect(GDExtensionObjectPtr from, const char *signal, GDExtensionObjectPtr to, const char *method);

/* Emits a signal with `count` arguments (at most 2), still owned by the caller. */
void gd_emit(GDExtensionObjectPtr object, const char *signal, const gd_variant *arguments, uint32_t count);

/* The object, if it is of that engine class, else null. */
GDExtensionObjectPtr gd_cast(GDExtensionObjectPtr object, const char *class_name);

int gd_is_in_editor(void);

/* A node's name in a caller's buffer. */
void gd_node_name(GDExtensionObjectPtr node, char *text, size_t size);

/* Puts a value under a key into a Dictionary. */
void gd_dictionary_set(void *dictionary, const char *key, GDExtensionVariantType type, const void *value);

#endif
