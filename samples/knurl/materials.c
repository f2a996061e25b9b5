/* Everyday materials. Written by assets/make/materials.py from assets/materials.json.
 * SPDX-License-Identifier: MIT */
/* clang-format off */
#include "materials.h"

const material materials[MATERIAL_COUNT] = {
    {"bamboo_mat",
     "{\"spatial_frequency\":[250,0],\"amplitude\":0.0006,\"stiffness\":500,\"friction\":0.3}"},
    {"braille",
     "{\"spatial_frequency\":[427.35,427.35],\"amplitude\":0.00024,\"stiffness\":500,\"friction\":0.3}"},
    {"cardboard_c",
     "{\"spatial_frequency\":[127.95,0],\"amplitude\":0.0018,\"stiffness\":300,\"friction\":0.5}"},
    {"cardboard_e",
     "{\"spatial_frequency\":[295.28,0],\"amplitude\":0.0006,\"stiffness\":300,\"friction\":0.5}"},
    {"coin_dime",
     "{\"spatial_frequency\":[2097.2,0],\"amplitude\":7.5e-05,\"stiffness\":800,\"friction\":0.2}"},
    {"coin_quarter",
     "{\"spatial_frequency\":[1561.4,0],\"amplitude\":0.0001,\"stiffness\":800,\"friction\":0.2}"},
    {"comb",
     "{\"spatial_frequency\":[666.7,0],\"amplitude\":0.0004,\"stiffness\":500,\"friction\":0.2}"},
    {"corduroy",
     "{\"spatial_frequency\":[433.07,0],\"amplitude\":0.0003,\"stiffness\":250,\"friction\":0.6}"},
    {"corduroy_fine",
     "{\"spatial_frequency\":[787.4,0],\"amplitude\":0.00015,\"stiffness\":250,\"friction\":0.6}"},
    {"decking",
     "{\"spatial_frequency\":[142.86,0],\"amplitude\":0.0008,\"stiffness\":700,\"friction\":0.4}"},
    {"denim",
     "{\"spatial_frequency\":[1250,0],\"amplitude\":6e-05,\"stiffness\":300,\"friction\":0.5,\"orientation\":1.1}"},
    {"file",
     "{\"spatial_frequency\":[984.25,0],\"amplitude\":0.00015,\"stiffness\":800,\"friction\":0.5,\"orientation\":0.4363}"},
    {"gear_rack",
     "{\"spatial_frequency\":[636.62,0],\"amplitude\":0.00056,\"stiffness\":800,\"friction\":0.2}"},
    {"grille",
     "{\"spatial_frequency\":[333.33,333.33],\"amplitude\":0.0003,\"stiffness\":700,\"friction\":0.3}"},
    {"guitar_string",
     "{\"spatial_frequency\":[3030.3,0],\"amplitude\":5e-05,\"stiffness\":600,\"friction\":0.2}"},
    {"knurl_diamond",
     "{\"spatial_frequency\":[1250,1250],\"amplitude\":0.0002,\"stiffness\":800,\"friction\":0.3,\"orientation\":0.7854}"},
    {"knurl_straight",
     "{\"spatial_frequency\":[1000,0],\"amplitude\":0.00025,\"stiffness\":800,\"friction\":0.3}"},
    {"lenticular",
     "{\"spatial_frequency\":[2952.8,0],\"amplitude\":3e-05,\"stiffness\":600,\"friction\":0.3}"},
    {"ribbed_rubber",
     "{\"spatial_frequency\":[333.33,0],\"amplitude\":0.0005,\"stiffness\":250,\"friction\":0.9}"},
    {"ribbon_cable",
     "{\"spatial_frequency\":[787.4,0],\"amplitude\":0.0002,\"stiffness\":350,\"friction\":0.4}"},
    {"ruler",
     "{\"spatial_frequency\":[1000,0],\"amplitude\":2.5e-05,\"stiffness\":800,\"friction\":0.2}"},
    {"screw_m3",
     "{\"spatial_frequency\":[2000,0],\"amplitude\":0.00015,\"stiffness\":800,\"friction\":0.2}"},
    {"screw_m6",
     "{\"spatial_frequency\":[1000,0],\"amplitude\":0.00031,\"stiffness\":800,\"friction\":0.2}"},
    {"tiles",
     "{\"spatial_frequency\":[37.04,37.04],\"amplitude\":0.0005,\"stiffness\":800,\"friction\":0.2}"},
    {"timing_belt_gt2",
     "{\"spatial_frequency\":[500,0],\"amplitude\":0.00038,\"stiffness\":400,\"friction\":0.6}"},
    {"timing_belt_t5",
     "{\"spatial_frequency\":[200,0],\"amplitude\":0.0006,\"stiffness\":400,\"friction\":0.6}"},
    {"toy_brick",
     "{\"spatial_frequency\":[125,125],\"amplitude\":0.00085,\"stiffness\":700,\"friction\":0.3}"},
    {"woven_belt",
     "{\"spatial_frequency\":[454.55,454.55],\"amplitude\":0.0002,\"stiffness\":350,\"friction\":0.6}"},
    {"zip",
     "{\"spatial_frequency\":[666.7,0],\"amplitude\":0.00025,\"stiffness\":400,\"friction\":0.3}"}};

const char *materials_text(void) {
    return
           "  bamboo_mat        Bamboo mat\n"
           "  braille           Braille cells, all dots raised\n"
           "  cardboard_c       Corrugated cardboard, C flute, one face open\n"
           "  cardboard_e       Corrugated cardboard, E flute, one face open\n"
           "  coin_dime         Edge of a US dime\n"
           "  coin_quarter      Edge of a US quarter\n"
           "  comb              Comb\n"
           "  corduroy          Corduroy\n"
           "  corduroy_fine     Pinwale corduroy\n"
           "  decking           Grooved decking\n"
           "  denim             Denim's twill lines\n"
           "  file              Metal file, coarse\n"
           "  gear_rack         Gear rack, module 0.5\n"
           "  grille            Loudspeaker grille\n"
           "  guitar_string     Wound guitar string\n"
           "  knurl_diamond     Diamond knurl (RGE 0.8)\n"
           "  knurl_straight    Straight knurl (RAA 1)\n"
           "  lenticular        Lenticular print\n"
           "  ribbed_rubber     Ribbed rubber mat\n"
           "  ribbon_cable      Ribbon cable\n"
           "  ruler             Engraved ruler\n"
           "  screw_m3          Screw thread M3\n"
           "  screw_m6          Screw thread M6\n"
           "  tiles             Mosaic tiles\n"
           "  timing_belt_gt2   Timing belt GT2, 2 mm\n"
           "  timing_belt_t5    Timing belt T5\n"
           "  toy_brick         Toy brick's studs\n"
           "  woven_belt        Woven belt\n"
           "  zip               Zip fastener, closed\n";
}
