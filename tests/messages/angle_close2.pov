camera { location <0, 1, -5 look_at 0 }
sphere { 0, 1 }
