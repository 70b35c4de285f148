// The linear value of a displayed one: IEC 61966-2-1.
float linear_grey(float k) {
    return k <= 0.04045 ? k / 12.92 : pow((k + 0.055) / 1.055, 2.4);
}
