camera { location 1 look_at 1 }
sphere { 0, 1 }
