// Images with filter and transmit that end light where they are mapped by texture coordinates or blended.
#version 3.7;
global_settings { assumed_gamma 1 }
camera { location <0,5,-6> look_at <0,-0.2,0.2> angle 50 }
light_source { <-4,9,3>, 1 parallel point_at 0 }
plane { y, -1 pigment { rgb 1 } }
#macro Pane (Image, Across, Along) disc { <Across, 0, Along>, y, 0.6 pigment { Image } } #end
#declare Photo = pigment { image_map { jpeg "images/fourth.jpg" transmit all 0.6 } };
#declare Shown = pigment { image_map { gif "images/palette.gif" transmit all 0.6 } };
#declare Tinted = pigment { image_map { gif "images/palette.gif" filter all 0.6 } };
Pane (pigment { Photo }, -2.4, 1.4)
Pane (pigment { uv_mapping Photo }, -0.8, 1.4)
Pane (pigment { uv_mapping Shown }, 0.8, 1.4)
Pane (pigment { uv_mapping Tinted }, 2.4, 1.4)
Pane (pigment { gradient x pigment_map { [0 Photo] [1 rgb 1] } }, -2.4, 0)
Pane (pigment { gradient x pigment_map { [0 Photo] [1 rgbt 1] } }, -0.8, 0)
Pane (pigment { average pigment_map { [1 Photo] [1 rgb <0,0,1>] } }, 0.8, 0)
disc { <-2.4, 0, -1.4>, y, 0.6 texture { gradient x texture_map { [0 pigment { uv_mapping Photo }] [1 pigment { rgb 1 }] } } }
disc { <-0.8, 0, -1.4>, y, 0.6 texture { pigment { rgbt 0.5 } } texture { pigment { uv_mapping Photo } } }
disc { <0.8, 0, -1.4>, y, 0.6 texture { uv_mapping pigment { Photo } } }
disc { <2.4, 0, -1.4>, y, 0.6 pigment { rgbt 0.5 } interior_texture { pigment { uv_mapping Photo } } }
