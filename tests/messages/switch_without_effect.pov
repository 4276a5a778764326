// doubts in lines 3, 4, 5: switches that these objects do not have
camera { location -5*z look_at 0 }
sphere { 0, 1 sturm }
difference { box { 0, 1 } sphere { 0, 1 } split_union off }
torus { 1, 0.5 sturm hierarchy off }
light_source { <4, 6, -8>, rgb 1 }
